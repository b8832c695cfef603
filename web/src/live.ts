// A running engine at the other end of a WebSocket.

import { decodeFrame, parseMessage, ProtocolError, type Request } from "./protocol";
import type { Listener, Source } from "./source";
import { Tape } from "./tape";

const ROOM = 48e6; // bytes of frames kept for trails, per run

export class LiveSource implements Source {
  readonly live = true;
  private socket: WebSocket | null = null;
  private tapes: Tape[] = [];
  private epochs: number[] = [];

  constructor(
    private readonly address: string,
    private readonly listener: Listener,
  ) {}

  tape(run: number): Tape {
    return (this.tapes[run] ??= new Tape(ROOM));
  }

  connect(): void {
    this.tapes = [];
    this.epochs = [];
    const socket = new WebSocket(this.address);
    let opened = false;
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      opened = true;
    };
    socket.onmessage = ({ data }) => {
      this.receive(data as string | ArrayBuffer);
    };
    socket.onclose = ({ reason }) => {
      if (this.socket !== socket) return;
      this.socket = null;
      this.listener.lost(reason || (opened ? "The connection to the engine is lost." : "The engine does not answer."));
    };
    this.socket = socket;
  }

  send(request: Request): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(request));
  }

  private receive(data: string | ArrayBuffer): void {
    try {
      if (typeof data === "string") this.read(data);
      else {
        const frame = decodeFrame(data);
        this.tape(frame.run).add(frame);
        this.listener.frame(frame);
      }
    } catch (error) {
      if (!(error instanceof ProtocolError)) throw error;
      this.listener.failure({ type: "error", message: error.message });
    }
  }

  private read(text: string): void {
    const message = parseMessage(text);
    switch (message.type) {
      case "hello":
        return this.listener.hello(message);
      case "history":
        return this.listener.past(message);
      case "scene":
        if (message.scene.epoch > (this.epochs[message.run] ?? -1)) {
          this.epochs[message.run] = message.scene.epoch;
          this.tape(message.run).cut(message.scene.since); // what came after was undone
        }
        return this.listener.scene(message.run, message.scene);
      case "numbers":
        return this.listener.measured(message);
      case "file":
        return this.listener.file(message);
      case "status":
        return this.listener.status(message);
      case "error":
        return this.listener.failure(message);
    }
  }
}
