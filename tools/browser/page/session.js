/* session.js -- the session: a worker in which the library computes, its messages, and what to do again when it had to be ended.
 *
 * There is no way to stop a computation but to end its thread. What the session knew is then made anew: every piece that was
 * carried out before is carried out again, when the next one is asked.
 */

let worker = null, ready = null, count = 0, stopped = null;
let stale = false;  /* the worker is new: `done` has to be carried out first */
const done = [];    /* what was carried out since the session began: {line, text, source} */
let typed = 0;      /* number of lines typed at the prompt since then */
const calls = new Map(), files = new Map();
let tell = {status() {}, progress() {}};

/* What runs in the worker, and the module it calls: module.js brings both as texts, since a page that is opened as a file may
 * start no worker of a file beside it, nor read one. */
function moduleFiles() {
    return new Promise((good, bad) => {
        if (globalThis.qdotModuleFiles)
            return good(globalThis.qdotModuleFiles);
        const script = document.createElement("script");
        script.src = "module.js";
        script.onload = () => good(globalThis.qdotModuleFiles);
        script.onerror = () => bad(new Error("module.js is missing"));
        document.head.append(script);
    });
}

async function newWorker() {
    if (typeof DecompressionStream === "undefined" || typeof WebAssembly === "undefined")
        throw new Error("this browser is too old; one of 2023 or later is needed");
    const {source, wasm} = await moduleFiles(), packed = await fetch("data:application/gzip;base64," + wasm);
    const bytes = await new Response(packed.body.pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
    const w = new Worker(URL.createObjectURL(new Blob([`onmessage = event => { self.qdotBytes = event.data;\n${source}\n}`])));
    w.postMessage(bytes, [bytes]);
    return w;
}

function start() {
    ready = newWorker().then(w => new Promise((good, bad) => {
        worker = w;
        w.onmessage = ({data}) => {
            if (data.kind === "ready") {
                for (const [name, bytes] of files)
                    w.postMessage({id: 0, kind: "write", name, bytes});
                good(data);
            } else if (data.kind === "progress") {
                tell.progress(data);
            } else if (data.id === undefined) {
                bad(new Error(data.message));
            } else if (calls.has(data.id)) {
                const {some, end} = calls.get(data.id);
                if (data.kind === "begin" || data.kind === "piece")
                    return some(data);
                calls.delete(data.id);
                end(data);
            }
        };
        w.onerror = event => bad(new Error(event.message || "the session could not be started"));
    }));
    ready.catch(() => {});
    return ready;
}

function restart() {
    const all = [...calls.values()];
    if (worker)
        worker.terminate();
    worker = null;
    calls.clear();
    stale = done.length > 0;
    start();
    all.forEach(c => c.end({kind: "stopped"}));
}

/* Begin the first session; `listener` has status(text), progress({what, done, left}). Its version, and
 * the style of what it writes. */
export function begin(listener) {
    tell = listener;
    return start();
}

/* Send a message to the worker; its last answer, {kind: "end", ...}, "stopped", or "lost" with a message. */
export function call(message, some = () => {}) {
    return ready.then(() => new Promise(end => {
        const id = ++count;
        calls.set(id, {some, end});
        worker.postMessage({...message, id});
    }), failure => ({kind: "lost", message: failure.message}));
}

export const isRunning = () => stopped !== null;
export const isNew = () => done.length === 0;

/* End the computation; the promise is fulfilled when carryOut has returned. */
export function stop() {
    const ended = stopped;
    if (ended)
        restart();
    return ended || Promise.resolve();
}

/* Write a file that statements read. */
export function write(name, bytes) {
    files.set(name, bytes);
    return call({kind: "write", name, bytes});
}

/* Carry out a text, piece by piece; fresh: in a session of its own. some(data) is told when a piece begins and when it has its
 * answers. The last answer of the worker. */
export async function carryOut(text, fresh, some) {
    let free;
    stopped = new Promise(good => { free = good; });
    const end = await carryOutPieces(text, fresh, some);
    if (end.kind === "lost")
        restart();
    stopped = null;
    free();
    return end;
}

async function carryOutPieces(text, fresh, some) {
    if (fresh)
        done.length = 0;
    else if (stale)
        for (const {line, text: again, source} of done) {
            tell.status(`once more: ${again.trim().split("\n")[0]}`);
            const end = await call({kind: "ask", text: again, line, source});
            if (end.kind !== "end")
                return end;
        }
    stale = false;
    tell.status("computing…");
    const source = fresh ? "script" : "prompt"; /* what errors call it */
    const line = fresh ? 1 : typed + 1;
    typed = fresh ? 0 : typed + text.split("\n").length;
    return call({kind: "ask", text, line, fresh, source}, data => {
        if (data.kind === "piece")
            done.push({line: data.line, text: data.text, source});
        some(data);
    });
}
