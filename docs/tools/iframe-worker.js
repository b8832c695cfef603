// The search is a worker, which browsers refuse to a page that was opened from disk: there, a hidden frame runs it.
if (location.protocol === "file:") {
  window.Worker = class {
    onmessage = null;
    onerror = null;
    #frame = document.createElement("iframe");
    #ready;

    constructor(url) {
      this.#frame.hidden = true;
      this.#frame.srcdoc = "<!doctype html>";
      this.#ready = new Promise((resolve) => {
        this.#frame.onload = () => {
          const inner = this.#frame.contentWindow;
          inner.postMessage = (data) => {
            const copy = structuredClone(data); // as between workers: neither side changes what the other holds
            setTimeout(() => this.onmessage?.({ data: copy }));
          };
          const script = inner.document.createElement("script");
          script.src = url;
          script.onload = () => resolve(inner);
          script.onerror = (error) => this.onerror?.(error);
          inner.document.head.append(script);
        };
      });
      document.body.append(this.#frame);
    }

    postMessage(data) {
      const copy = structuredClone(data);
      this.#ready.then((inner) => inner.onmessage({ data: copy }));
    }

    terminate() {
      this.#frame.remove();
    }
  };
}
