// Frames made by hand, byte by byte as docs/reference/view-protocol.md says.

export interface Made {
  run?: number;
  epoch?: number;
  step?: number;
  x?: number[];
  y?: number[];
  degree?: number[];
  flags?: number[];
  targets?: [number, number, number][]; // x, y [m], present
  version?: number; // 3: lean
  links?: number[][]; // a row of bytes for each agent
  measures?: number[];
  memory?: number[][]; // of each field, a number for each agent
}

export function makeFrame(made: Made): ArrayBuffer {
  const x = made.x ?? [0, 1];
  const agents = x.length;
  const targets = made.targets ?? [[2, 3, 1]];
  const links = made.links ?? [];
  const lean = made.version === 3;
  const bytes = new ArrayBuffer(84 + (lean ? 9 : 23) * agents + 9 * targets.length + links.flat().length + 4 * (made.memory ?? []).flat().length);
  const view = new DataView(bytes);
  view.setUint8(0, made.version ?? 4);
  view.setUint8(1, made.run ?? 0);
  view.setUint16(2, made.epoch ?? 0, true);
  view.setUint32(4, made.step ?? 0, true);
  view.setUint32(8, agents, true);
  view.setUint32(12, targets.length, true);
  view.setUint16(16, links[0]?.length ?? 0, true);
  for (const [n, value] of (made.measures ?? []).entries()) view.setFloat32(20 + 4 * n, value, true);
  view.setUint16(18, made.memory?.length ?? 0, true);
  let at = 84;
  const floats = (values: number[]): void => {
    for (const value of values) view.setFloat32(at, value, true), (at += 4);
  };
  floats(x);
  floats(made.y ?? x.map(() => 0));
  for (let n = 0; n < (lean ? 0 : 3); n++) floats(x.map((_, agent) => 10 * n + agent));
  floats((made.memory ?? []).flat());
  floats(targets.map((target) => target[0]));
  floats(targets.map((target) => target[1]));
  for (const degree of lean ? [] : (made.degree ?? x.map(() => 1))) view.setUint16(at, degree, true), (at += 2);
  for (const flags of made.flags ?? x.map(() => 2)) view.setUint8(at++, flags);
  for (const target of targets) view.setUint8(at++, target[2]);
  for (const byte of links.flat()) view.setUint8(at++, byte);
  return bytes;
}
