// Code of the worker after the engine's script, which defines createEngine(): a folder of files and answers to
// requests, one after the other.
let engine = null;
let asked = null;

// Called by the engine during its work, through progress.js.
globalThis.lyrefitProgress = (text) => postMessage({id: asked, progress: JSON.parse(text)});

async function start(module) {
  engine = await createEngine({
    instantiateWasm(imports, done) {
      WebAssembly.instantiate(module, imports).then(done);
      return {};
    },
  });
  engine.FS.mkdir('/measurements');
  engine.FS.chdir('/measurements');
}

const actions = {
  start: ({module}) => start(module),
  write: ({name, bytes}) => engine.FS.writeFile(name, bytes),
  remove: ({name}) => engine.FS.unlink(name),
  run: ({request}) => engine.ccall('lyrefit_run', 'string', ['string'], [JSON.stringify(request)]),
};

let before = Promise.resolve();
onmessage = ({data}) => {
  before = before.then(async () => {
    asked = data.id;
    try {
      const answer = await actions[data.action](data);
      if (data.action === 'run') postMessage({id: data.id, answer: JSON.parse(answer), memory: engine.HEAPU8.length});
    } catch (error) {
      postMessage({id: data.id, failure: String(error)});
    }
  });
};
