// Engines of the page: each is a separate worker with a copy of the files. Defines Engine, and engineParts(), which
// returns a promise of the unpacked and compiled parts; they are shared.
// Unpacks an element in which five letters stand for four bytes (bundle.mjs).
function unpackTight(id) {
  const {textContent: text, dataset} = document.getElementById(id);
  const values = new Uint8Array(128);
  for (let code = 35, value = 0; code < 127; ++code) if (!'&<\\`'.includes(String.fromCharCode(code))) values[code] = value++;
  const bytes = new DataView(new ArrayBuffer(text.length / 5 * 4));
  for (let i = 0; i < text.length; i += 5) {
    let word = 0;
    for (let k = i; k < i + 5; ++k) word = 85 * word + values[text.charCodeAt(k)];
    bytes.setUint32(i / 5 * 4, word);
  }
  const stream = new Blob([bytes.buffer.slice(0, Number(dataset.bytes))]).stream();
  return new Response(stream.pipeThrough(new DecompressionStream('gzip'))).arrayBuffer();
}

let partsPromise = null;
function engineParts() {
  partsPromise ??= (async () => {
    const [wasm, script] = await Promise.all([unpackTight('engine-wasm'), lyrefit.bytes('engine-script')]);
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
