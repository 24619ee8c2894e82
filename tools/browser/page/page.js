/* page.js -- the page: editor, buttons, the session in worker.js, answers, links, files. */
import CodeMirror from "codemirror";
import "codemirror/addon/hint/show-hint.js";
import "codemirror/addon/edit/matchbrackets.js";
import "codemirror/addon/comment/comment.js";
import "codemirror/addon/selection/active-line.js";
import {elementsOf} from "./answers.js";
import qdotMode from "./qdot-mode.js"; /* share/codemirror/qdot.js */

const $ = id => document.getElementById(id);
const FIRST = `# A pendulum. Ctrl-Enter runs the script.
param m, l, g > 0
coord theta
particle bob mass m at (l*sin(theta), -l*cos(theta))
gravity (0, -g)

eom
check conserved energy

set m = 1, l = 1, g = 9.81
start theta = 2
run 0..10
plot theta, theta'
animate
`;

qdotMode.define(CodeMirror);
const editor = CodeMirror($("left"), {
    mode: "qdot", lineNumbers: true, matchBrackets: true, styleActiveLine: true, lineWrapping: false, indentUnit: 4,
    viewportMargin: 50, inputStyle: "contenteditable", hintOptions: {hint: hints, completeSingle: true},
    extraKeys: {
        "Ctrl-Enter": runAll, "Cmd-Enter": runAll, "Shift-Enter": runToCursor, "Ctrl-Space": cm => cm.showHint(),
        "Ctrl-/": cm => cm.toggleComment({lineComment: "#"}), "F1": explain, "Esc": () => stop(),
        Tab: cm => /\w/.test(cm.getRange({...cm.getCursor(), ch: cm.getCursor().ch - 1}, cm.getCursor())) && !cm.somethingSelected()
            ? cm.showHint() : cm.execCommand("indentMore"),
        "Shift-Tab": "indentLess",
    },
});
editor.getInputField().setAttribute("aria-label", "Script");

/* --- the session ---------------------------------------------------------------------------- */

let worker = null, ready = null, count = 0, running = null;
let history = []; /* what was asked after the last run of the script, with that before it: what a new worker has to do again */
let stale = false; /* the worker is new: the history has to be carried out first */
const calls = new Map(), files = new Map();

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
    const {source, wasm} = await moduleFiles(), packed = Uint8Array.from(atob(wasm), c => c.charCodeAt(0));
    const bytes = await new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
    const w = new Worker(URL.createObjectURL(new Blob([`onmessage = event => { self.qdotBytes = event.data;\n${source}\n}`])));
    w.postMessage(bytes, [bytes]);
    return w;
}

function start() {
    status("loading…");
    ready = newWorker().then(w => new Promise((good, bad) => {
        worker = w;
        w.onmessage = ({data}) => {
            if (data.kind === "ready") {
                status(`qdot ${data.version}, ready`);
                document.documentElement.dataset.ready = "yes";
                for (const [name, bytes] of files)
                    w.postMessage({id: 0, kind: "write", name, bytes});
                good();
            } else if (data.kind === "progress") {
                $("progress").hidden = false;
                if (isFinite(data.done))
                    $("progress").value = data.done;
                status(data.what + (data.left > 1 ? `, ${Math.ceil(data.left)} s left` : "…"));
            } else if (data.id === undefined) {
                bad(new Error(data.message));
            } else if (calls.has(data.id)) {
                const call = calls.get(data.id);
                if (data.kind === "answers")
                    call.some(data);
                else {
                    calls.delete(data.id);
                    call.end(data);
                }
            }
        };
        w.onerror = event => bad(new Error(event.message || "the session could not be started"));
    }));
    ready.catch(failure => status("not started: " + failure.message));
}

function call(message, some = () => {}) {
    return ready.then(() => new Promise(end => {
        const id = ++count;
        calls.set(id, {some, end});
        worker.postMessage({...message, id});
    }));
}

/* End the computation with its thread, and begin another; what was asked before is done again when it is needed. */
function stop() {
    if (!running)
        return;
    worker.terminate();
    const all = [...calls.values()];
    calls.clear();
    stale = history.length > 0;
    start();
    all.forEach(c => c.end({kind: "stopped"}));
}

function status(text) {
    $("status").textContent = text;
}

/* Carry out a text as part of the session; its answers below those that are there. */
async function carryOut(text, first, fresh, shown) {
    if (running)
        return;
    running = text;
    for (const id of ["run", "run-to"])
        $(id).disabled = true;
    $("stop").disabled = false;
    document.documentElement.dataset.running = "yes";
    status("computing…");
    const begun = performance.now();
    if (stale && !fresh)
        for (const h of history)
            await call({kind: "ask", ...h});
    stale = false;
    if (fresh)
        history = [];
    const end = await call({kind: "ask", text, first, fresh}, data => shown(data));
    if (end.kind === "end")
        history.push({text, first, fresh});
    running = null;
    for (const id of ["run", "run-to"])
        $(id).disabled = false;
    $("stop").disabled = true;
    $("progress").hidden = true;
    delete document.documentElement.dataset.running;
    const seconds = ((performance.now() - begun) / 1000).toPrecision(2);
    status(end.kind === "stopped" ? "stopped" : end.kind === "lost" ? "the session was lost: " + end.message
        : (end.good ? "done" : "stopped at an error") + ` in ${Number(seconds)} s`);
    if (end.kind === "stopped")
        $("answers").append(Object.assign(document.createElement("div"), {className: "answer notice", textContent: "stopped"}));
    if (end.kind === "lost") {
        worker.terminate();
        stale = true;
        start();
    }
}

/* --- answers ---------------------------------------------------------------------------------- */

let marked = [];

function clearAnswers() {
    $("answers").replaceChildren();
    marked.splice(0).forEach(line => editor.removeLineClass(line, "background", "wrong"));
}

function show(data, source, ofScript) {
    const pane = $("answers"), low = pane.scrollHeight - pane.scrollTop - pane.clientHeight < 80;
    const box = document.createElement("div"), asked = document.createElement("button");
    box.className = "answer";
    asked.className = "asked";
    asked.textContent = data.text.split("\n")[0].trim();
    asked.title = ofScript ? `line ${data.line}` : "";
    if (ofScript)
        asked.addEventListener("click", () => {
            editor.setCursor(data.line - 1, 0);
            editor.focus();
        });
    box.append(asked, ...elementsOf(data.answers, source));
    pane.append(box);
    for (const a of data.answers)
        if (a.kind === "error" && ofScript && a.line && (!a.file || a.file === "ask"))
            marked.push(editor.addLineClass(a.line - 1, "background", "wrong"));
    if (low && !ofScript)
        pane.scrollTop = pane.scrollHeight;
}

function runAll() {
    runText(editor.getValue());
}

function runToCursor() {
    runText(editor.getRange({line: 0, ch: 0}, {line: editor.getCursor().line, ch: 1e6}));
}

function runText(text) {
    if (running)
        return;
    clearAnswers();
    keep();
    carryOut(text, 0, true, data => show(data, text, true));
}

$("answers").addEventListener("click", async event => {
    const name = event.target.dataset && event.target.dataset.file;
    if (name) {
        const {bytes} = await call({kind: "read", name});
        give(name.split("/").pop(), bytes);
    }
});

const lines = [];
let lineAt = 0;
$("ask").addEventListener("submit", event => {
    event.preventDefault();
    const text = $("line").value;
    if (text.trim() === "" || running)
        return;
    lines.push(text);
    lineAt = lines.length;
    $("line").value = "";
    if ($("answers").querySelector(".empty"))
        clearAnswers();
    const run = history.length === 0 && !stale;
    carryOut(text, 0, run, data => show(data, text, false));
});
$("line").addEventListener("keydown", event => {
    const step = {ArrowUp: -1, ArrowDown: 1}[event.key];
    if (step && lineAt + step >= 0 && lineAt + step <= lines.length) {
        lineAt += step;
        $("line").value = lines[lineAt] || "";
        event.preventDefault();
    } else if (event.key === "Escape") {
        stop();
    }
});

/* --- completion and help ------------------------------------------------------------------------ */

async function hints(cm) {
    const at = cm.getCursor();
    if (running)
        return null;
    const text = cm.getRange({line: at.line, ch: 0}, at), names = declared(cm.getValue());
    const {words, start} = await call({kind: "complete", text, cursor: text.length});
    const word = /[A-Za-z_]\w*$/.exec(text), own = word ? names.filter(n => n.startsWith(word[0]) && n !== word[0]) : [];
    const from = words.length > 0 ? start : word ? word.index : at.ch;
    const list = [...new Set([...words.map(w => w.trimEnd()), ...own])];
    return list.length === 0 ? null : {list, from: {line: at.line, ch: from}, to: at};
}

/* The names that the script declares, also before it was run. */
function declared(text) {
    const found = new Set();
    for (const m of text.matchAll(/^\s*(?:coord|param|particle|body|function|let|constraint|event|spring|damper|force)\s+([^:=\n#]*)/gm))
        for (const n of m[1].split(",")) {
            const name = /^\s*([A-Za-z_]\w*)/.exec(n);
            if (name)
                found.add(name[1]);
        }
    return [...found];
}

async function explain() {
    const at = editor.getCursor(), text = editor.getLine(at.line);
    if (running)
        return;
    const {said} = await call({kind: "explain", text, cursor: at.ch});
    document.querySelectorAll(".help").forEach(e => e.remove());
    if (!said || !said.word) {
        status("nothing is known of what stands at the cursor");
        return;
    }
    const box = document.createElement("div"), place = editor.cursorCoords(true, "window"), head = document.createElement("pre");
    box.className = "help";
    head.textContent = said.usage || said.word;
    box.append(head, said.text || "", ...(said.example ? [Object.assign(document.createElement("pre"), {textContent: said.example})] : []));
    box.style.left = Math.min(place.left, innerWidth * 0.5) + "px";
    box.style.top = Math.min(place.bottom + 4, innerHeight - 160) + "px";
    document.body.append(box);
    const away = () => box.remove();
    editor.on("cursorActivity", away);
    document.addEventListener("mousedown", away, {once: true});
}

/* --- links, files, looks --------------------------------------------------------------------------- */

const toLink = bytes => btoa(String.fromCharCode(...bytes)).replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
const fromLink = text => Uint8Array.from(atob(text.replace(/-/g, "+").replace(/_/g, "/")), c => c.charCodeAt(0));

async function through(stream, bytes) {
    return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());
}

$("share").addEventListener("click", async () => {
    const packed = await through(new CompressionStream("deflate-raw"), new TextEncoder().encode(editor.getValue()));
    location.replace("#script=" + toLink(packed));
    try {
        await navigator.clipboard.writeText(location.href);
        status("the link is on the clipboard: it holds the script");
    } catch {
        status("the link is in the address line: it holds the script");
    }
});

/* The script that the address holds, or null. */
async function scriptOfLink() {
    const coded = /#script=([\w-]+)/.exec(location.hash);
    try {
        return coded && new TextDecoder().decode(await through(new DecompressionStream("deflate-raw"), fromLink(coded[1])));
    } catch {
        status("the link is damaged: it holds no script");
        return null;
    }
}
addEventListener("hashchange", async () => {
    const script = await scriptOfLink();
    if (script !== null && script !== editor.getValue())
        editor.setValue(script);
});

function give(name, bytes) {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([bytes]));
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

$("save").addEventListener("click", () => give("script.lag", editor.getValue()));
$("open").addEventListener("change", async event => {
    for (const file of event.target.files) {
        if (/\.lag$|\.txt$/.test(file.name) && event.target.files.length === 1) {
            editor.setValue(await file.text());
            continue;
        }
        files.set(file.name, new Uint8Array(await file.arrayBuffer()));
        await call({kind: "write", name: file.name, bytes: files.get(file.name)});
        status(`${file.name} can be read by statements`);
    }
    event.target.value = "";
});

function keep() {
    try {
        localStorage.setItem("qdot-script", editor.getValue());
    } catch { /* a browser that keeps nothing */ }
}

function setTheme(dark) {
    document.documentElement.classList.toggle("dark", dark);
    try {
        localStorage.setItem("qdot-theme", dark ? "dark" : "light");
    } catch { /* the same */ }
}

function kept(key) {
    try {
        return localStorage.getItem(key);
    } catch {
        return null;
    }
}
setTheme(kept("qdot-theme") ? kept("qdot-theme") === "dark" : matchMedia("(prefers-color-scheme: dark)").matches);
$("theme").addEventListener("click", () => setTheme(!document.documentElement.classList.contains("dark")));
$("run").addEventListener("click", runAll);
$("run-to").addEventListener("click", runToCursor);
$("stop").addEventListener("click", stop);
addEventListener("keydown", event => {
    if ((event.ctrlKey || event.metaKey) && event.key === "Enter" && !event.defaultPrevented)
        runAll();
});

/* Examples: {name, title, text, files: {name: text}}. */
const script = document.createElement("script");
script.src = "examples.js";
script.onload = () => globalThis.qdotExamples.forEach((e, i) => $("examples").append(new Option(e.title, i)));
document.head.append(script);
$("examples").addEventListener("change", event => {
    const example = globalThis.qdotExamples[event.target.value];
    event.target.value = "";
    if (!example)
        return;
    for (const [name, text] of Object.entries(example.files)) {
        files.set(name, new TextEncoder().encode(text));
        call({kind: "write", name, bytes: files.get(name)});
    }
    history = [];
    editor.setValue(example.text);
    runAll();
});

if (location.protocol.startsWith("http") && "serviceWorker" in navigator)
    navigator.serviceWorker.register("service.js").catch(() => {});

start();
scriptOfLink().then(linked => {
    editor.setValue(linked ?? (kept("qdot-script") || FIRST));
    if ($("answers").children.length === 0)
        $("answers").innerHTML = "<p class='empty'>The script is carried out in this page: nothing is sent anywhere. <b>Ctrl-Enter</b> runs it, " +
            "<b>Shift-Enter</b> up to the cursor's line, <b>Tab</b> or <b>Ctrl-Space</b> completes a word, <b>F1</b> explains it, <b>Esc</b> stops.</p>";
    editor.focus();
});
globalThis.qdotPage = {editor, call, runAll};
