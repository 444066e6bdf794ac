// Engines of the page: each is a separate worker with a copy of the files. Defines Engine, and engineParts(), which
// returns a promise of the unpacked and compiled parts; they are shared.
let partsPromise = null;
function engineParts() {
  partsPromise ??= (async () => {
    const [wasm, script] = await Promise.all([lyrefit.bytes('engine-wasm'), lyrefit.bytes('engine-script')]);
    const worker = document.getElementById('worker-script').textContent;
    return {
      module: await WebAssembly.compile(wasm),
      script: URL.createObjectURL(new Blob([script, '\n', worker], {type: 'text/javascript'})),
    };
  })();
  return partsPromise;
}

class Engine {
  constructor(parts) {
    this.parts = parts;
    this.files = new Map();
    this.waiting = new Map();  // callbacks of unanswered requests, by number
    this.last = 0;
    this.begin();
  }

  begin() {
    this.worker = new Worker(this.parts.script);
    this.worker.onmessage = ({data}) => this.hear(data);
    this.worker.onerror = (event) => {
      event.preventDefault();
      this.stop(`the engine failed: ${event.message}`);
    };
    this.worker.postMessage({action: 'start', module: this.parts.module});
    for (const [name, bytes] of this.files) this.worker.postMessage({action: 'write', name, bytes});
  }

  hear({id, answer, failure, progress, memory}) {
    const waiting = this.waiting.get(id);
    if (failure !== undefined && !waiting) {
      this.stop(`the engine failed: ${failure}`);
      return;
    }
    if (!waiting) return;
    if (progress) {
      waiting.progress?.(progress);
      return;
    }
    this.waiting.delete(id);
    if (failure === undefined) {
      this.memory = memory;
      waiting.done(answer);
    } else {
      // The memory of a failed engine may be corrupt: a new engine replaces it.
      waiting.done({error: `the engine failed: ${failure}`});
      this.stop('the engine was begun anew');
    }
  }

  write(name, bytes) {
    this.files.set(name, bytes);
    this.worker.postMessage({action: 'write', name, bytes});
  }

  remove(name) {
    if (this.files.delete(name)) this.worker.postMessage({action: 'remove', name});
  }

  // Promise of the answer to a request, with `stopped` if stop() came first.
  run(request, progress) {
    const id = ++this.last;
    return new Promise((done) => {
      this.waiting.set(id, {done, progress});
      this.worker.postMessage({action: 'run', id, request});
    });
  }

  // Ends all work at once and starts a new worker.
  stop(why) {
    this.worker.terminate();
    const waiting = [...this.waiting.values()];
    this.waiting.clear();
    this.begin();
    for (const each of waiting) each.done({error: why, stopped: true});
  }
}
