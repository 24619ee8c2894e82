/* page.js -- the page: editor, buttons, answers, completion and help. */
import CodeMirror from "codemirror";
import "codemirror/addon/hint/show-hint.js";
import "codemirror/addon/edit/matchbrackets.js";
import "codemirror/addon/comment/comment.js";
import "codemirror/addon/selection/active-line.js";
import {elementsOf, showsStatement} from "./answers.js";
import {keepScript, keepTheme, keptScript, keptTheme, linkOf, scriptOfLink} from "./keep.js";
import qdotMode from "./qdot-mode.js"; /* share/codemirror/qdot.js */
import * as session from "./session.js";

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
const INTRODUCTION = "<p class='empty'>The script is carried out in this page: nothing is sent anywhere. <b>Ctrl-Enter</b> runs it, " +
    "<b>Shift-Enter</b> up to the cursor's line, <b>Tab</b> or <b>Ctrl-Space</b> completes a word, <b>F1</b> explains it, <b>Esc</b> stops; " +
    "<b>Esc</b> and then <b>Tab</b> leaves the editor.</p>";

qdotMode.define(CodeMirror);
const editor = CodeMirror($("left"), {
    mode: "qdot", lineNumbers: true, matchBrackets: true, styleActiveLine: true, lineWrapping: false, indentUnit: 4,
    viewportMargin: 50, inputStyle: "contenteditable", hintOptions: {hint: hints, completeSingle: true},
    extraKeys: {
        "Ctrl-Enter": runAll, "Cmd-Enter": runAll, "Shift-Enter": runToCursor, "Ctrl-Space": cm => cm.showHint(),
        "Ctrl-/": cm => cm.toggleComment({lineComment: "#"}), "F1": explain, Tab: tab, "Shift-Tab": "indentLess",
    },
});
editor.getInputField().setAttribute("aria-label", "Script");

/* Tab completes a word and indents; after Esc it goes on to the next element, as on any page. */
let leaving = false;
editor.on("keydown", (cm, event) => {
    if (event.key === "Tab")
        event.codemirrorIgnore = leaving;
    else if (event.key !== "Shift")
        leaving = event.key === "Escape";
});

function tab(cm) {
    const {line, ch} = cm.getCursor(), behindWord = /[\p{L}\p{N}_]$/u.test(cm.getLine(line).slice(0, ch));
    return behindWord && !cm.somethingSelected() ? cm.showHint() : cm.execCommand("indentMore");
}

/* --- what is carried out ---------------------------------------------------------------------- */

let ran = null; /* the script that was run last */

function status(text) {
    $("status").textContent = text;
}

function setRunning(running) {
    for (const id of ["run", "run-to"])
        $(id).disabled = running;
    $("stop").disabled = !running;
    $("progress").hidden = true;
    $("progress").removeAttribute("value");
    if (running)
        document.documentElement.dataset.running = "yes";
    else
        delete document.documentElement.dataset.running;
}

/* Carry out a text; its answers below those that are there. Whether all of it succeeded. */
async function carryOut(text, ofScript) {
    const begun = performance.now(), focused = document.activeElement;
    let waiting = null, timer = 0;
    setRunning(true);
    const end = await session.carryOut(text, ofScript, data => {
        clearTimeout(timer);
        if (waiting)
            waiting.remove();
        waiting = null;
        if (data.kind === "begin")
            timer = setTimeout(() => { waiting = box(data, ofScript, said("computing…", "soft")); }, 250);
        else
            show(data, ofScript);
    });
    clearTimeout(timer);
    setRunning(false);
    const seconds = Number(((performance.now() - begun) / 1000).toPrecision(2));
    const outcome = {
        end: (end.good ? "done" : "stopped at an error") + ` in ${seconds} s`,
        stopped: `stopped after ${seconds} s; all that was done before is kept`,
        lost: "the computation broke off; all that was done before it is kept",
    }[end.kind];
    if (waiting)
        waiting.lastChild.textContent = end.kind === "lost" ? "broke off: " + end.message : "stopped";
    else if (end.kind === "lost")
        notice("The computation broke off: " + end.message);
    status(outcome + (ran !== null && editor.getValue() !== ran && !ofScript ? "; the script was changed since it was run" : ""));
    if (document.activeElement === document.body || document.activeElement === $("stop"))
        focused.focus();
    return end.kind === "end" && end.good;
}

function runAll() {
    return runText(editor.getValue());
}

function runToCursor() {
    return runText(editor.getRange({line: 0, ch: 0}, {line: editor.getCursor().line, ch: 1e6}));
}

async function runText(text) {
    if (session.isRunning())
        return false;
    clearAnswers();
    if (getComputedStyle(document.querySelector("main")).display === "block")
        $("right").scrollIntoView(); /* narrow windows: answers stand below the script */
    ran = editor.getValue();
    return carryOut(text, true);
}

const lines = [];
let lineAt = 0;
$("ask").addEventListener("submit", async event => {
    event.preventDefault();
    const text = $("line").value;
    if (text.trim() === "" || session.isRunning())
        return;
    if (session.isNew() && editor.getValue().trim() !== "" && !await runAll())
        return; /* the line goes on where the script ends */
    lines.push(text);
    lineAt = lines.length;
    $("line").value = "";
    if ($("answers").querySelector(".empty"))
        clearAnswers();
    carryOut(text, false);
});
$("line").addEventListener("keydown", event => {
    const step = {ArrowUp: -1, ArrowDown: 1}[event.key];
    if (step && lineAt + step >= 0 && lineAt + step <= lines.length) {
        lineAt += step;
        $("line").value = lines[lineAt] || "";
        event.preventDefault();
    }
});

/* --- answers ---------------------------------------------------------------------------------- */

const marked = [];

function clearAnswers() {
    $("answers").replaceChildren();
    marked.splice(0).forEach(line => editor.removeLineClass(line, "background", "wrong"));
}

function said(text, kind) {
    return Object.assign(document.createElement("div"), {className: kind, textContent: text});
}

function notice(text) {
    $("answers").append(said(text, "answer notice"));
}

/* A box among the answers: what was asked, and the elements below it. */
function box({text, line}, ofScript, ...elements) {
    const all = document.createElement("div"), asked = document.createElement("button"), [first, ...more] = text.trim().split("\n");
    all.className = "answer qdot";
    asked.className = "asked";
    asked.textContent = first + (more.length > 0 ? " …" : "");
    asked.title = ofScript ? `line ${line}` : "";
    asked.addEventListener("click", () => {
        if (ofScript)
            editor.setCursor(line - 1, 0);
        (ofScript ? editor : $("line")).focus();
    });
    all.append(asked, ...elements);
    $("answers").append(all);
    if (!ofScript)
        reveal(all);
    return all;
}

function reveal(element) {
    element.scrollIntoView({block: element.offsetHeight > $("answers").clientHeight ? "start" : "nearest"});
}

function show(data, ofScript) {
    if (data.answers.length === 0)
        return;
    const all = box(data, ofScript, ...elementsOf(data.answers, data.text.trim()));
    if (data.answers.every(showsStatement) && ofScript)
        all.firstChild.textContent = `line ${data.answers[0].line}`;
    else if (data.answers.every(showsStatement))
        all.firstChild.remove();
    for (const a of data.answers)
        if (a.kind === "error" && ofScript && a.line && (!a.file || a.file === "script"))
            marked.push(editor.addLineClass(a.line - 1, "background", "wrong"));
    if (data.answers.some(a => a.kind === "error"))
        reveal(all);
}

$("answers").addEventListener("click", async event => {
    const name = event.target.dataset && event.target.dataset.file;
    if (!name)
        return;
    const {bytes} = await session.call({kind: "read", name});
    if (bytes)
        give(name.split("/").pop(), bytes);
    else
        status(`${name} is not there any more; run the script again`);
});

/* --- completion and help ------------------------------------------------------------------------ */

async function hints(cm) {
    const at = cm.getCursor();
    if (session.isRunning())
        return null;
    const text = cm.getRange({line: at.line, ch: 0}, at), names = declared(cm.getValue());
    const {words = [], start} = await session.call({kind: "complete", text, cursor: text.length});
    const word = /[\p{L}_][\p{L}\p{N}_]*$/u.exec(text), own = word ? names.filter(n => n.startsWith(word[0]) && n !== word[0]) : [];
    const from = words.length > 0 ? start : word ? word.index : at.ch;
    const list = [...new Set([...words.map(w => w.trimEnd()), ...own])];
    return list.length === 0 ? null : {list, from: {line: at.line, ch: from}, to: at};
}

/* The names that the script declares, also before it was run. */
function declared(text) {
    const found = new Set();
    for (const m of text.matchAll(/^\s*(?:coord|param|particle|body|function|let|constraint|event|spring|damper|force)\s+([^:=\n#]*)/gm))
        for (const n of m[1].split(",")) {
            const name = /^\s*([\p{L}_][\p{L}\p{N}_]*)/u.exec(n);
            if (name)
                found.add(name[1]);
        }
    return [...found];
}

function closeHelp() {
    document.querySelectorAll(".help").forEach(e => e.remove());
}

async function explain() {
    const at = editor.getCursor(), text = editor.getLine(at.line);
    if (session.isRunning())
        return status("words are explained when the computation is done");
    const {said: known} = await session.call({kind: "explain", text, cursor: at.ch});
    closeHelp();
    if (!known || !known.word)
        return status("there is no help for what stands at the cursor");
    const help = document.createElement("div"), place = editor.cursorCoords(true, "window"), head = document.createElement("pre");
    help.className = "help";
    help.setAttribute("role", "status");
    head.textContent = known.usage || known.word;
    help.append(head, known.text || "", ...(known.example ? [Object.assign(document.createElement("pre"), {textContent: known.example})] : []));
    document.body.append(help);
    help.style.left = Math.max(4, Math.min(place.left, innerWidth - help.offsetWidth - 8)) + "px";
    help.style.top = Math.max(4, place.bottom + 4 + help.offsetHeight < innerHeight ? place.bottom + 4 : place.top - help.offsetHeight - 4) + "px";
}
editor.on("cursorActivity", closeHelp);
document.addEventListener("mousedown", closeHelp);

/* --- links, files, looks --------------------------------------------------------------------------- */

let fileName = "script.lag";

$("share").addEventListener("click", async () => {
    location.replace(await linkOf(editor.getValue()));
    try {
        await navigator.clipboard.writeText(location.href);
        status("the link is on the clipboard: it holds the script");
    } catch {
        status("the link is in the address line: it holds the script");
    }
});

addEventListener("hashchange", () => scriptOfLink().then(script => {
    if (script !== null && script !== editor.getValue())
        editor.setValue(script);
}, failure => notice(failure.message)));

function give(name, bytes) {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([bytes]));
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

function save() {
    give(fileName, editor.getValue());
}

/* A single script goes into the editor; everything else is a file that statements can read. */
async function openFiles(all) {
    const scripts = [...all].filter(file => /\.lag$/i.test(file.name)), script = scripts.length === 1 ? scripts[0] : null;
    const others = [...all].filter(file => file !== script);
    for (const file of others)
        await session.write(file.name, new Uint8Array(await file.arrayBuffer()));
    if (script) {
        editor.setValue(await script.text());
        fileName = script.name;
    }
    status([...(script ? [`${script.name} is in the editor`] : []), ...others.map(file => `statements can read "${file.name}"`)].join("; "));
}

$("save").addEventListener("click", save);
$("choose").addEventListener("click", () => $("open").click());
$("open").addEventListener("change", async event => {
    await openFiles(event.target.files);
    event.target.value = "";
});
document.addEventListener("dragover", event => event.preventDefault());
document.addEventListener("drop", event => {
    if (event.dataTransfer.files.length > 0) {
        event.preventDefault();
        event.stopPropagation();
        openFiles(event.dataTransfer.files);
    }
}, true);

function setTheme(dark) {
    document.documentElement.classList.toggle("dark", dark);
}
setTheme(keptTheme() ? keptTheme() === "dark" : matchMedia("(prefers-color-scheme: dark)").matches);
$("theme").addEventListener("click", () => {
    const dark = !document.documentElement.classList.contains("dark");
    setTheme(dark);
    keepTheme(dark ? "dark" : "light");
});
$("run").addEventListener("click", runAll);
$("run-to").addEventListener("click", runToCursor);
$("stop").addEventListener("click", () => session.stop());
addEventListener("keydown", event => {
    const command = (event.ctrlKey || event.metaKey) && !event.defaultPrevented;
    if (event.key === "Escape") {
        closeHelp();
        session.stop();
    } else if (command && event.key === "Enter") {
        runAll();
    } else if (command && event.key.toLowerCase() === "s" && !event.shiftKey) {
        event.preventDefault();
        save();
    }
});

/* A frame tells how high its page is. */
addEventListener("message", event => {
    for (const frame of document.querySelectorAll("iframe"))
        if (event.source === frame.contentWindow && typeof event.data.height === "number")
            frame.style.height = Math.min(Math.max(event.data.height, 100), 4000) + "px";
});

/* Examples: {name, title, text, files: {name: text}}. */
const script = document.createElement("script");
script.src = "examples.js";
script.onload = () => globalThis.qdotExamples.forEach((e, i) => $("examples").append(new Option(e.title, i)));
document.head.append(script);
$("examples").addEventListener("change", async event => {
    const example = globalThis.qdotExamples[event.target.value];
    event.target.value = "";
    if (!example)
        return;
    await session.stop();
    for (const [name, text] of Object.entries(example.files))
        session.write(name, new TextEncoder().encode(text));
    editor.setValue(example.text);
    fileName = example.name;
    runAll();
});

if (location.protocol.startsWith("http") && "serviceWorker" in navigator)
    navigator.serviceWorker.register("service.js").catch(() => {});

status("loading…");
session.begin({
    status,
    progress({what, done, left}) {
        $("progress").hidden = false;
        if (isFinite(done))
            $("progress").value = done;
        status(what + (left > 1 ? `, ${Math.ceil(left)} s left` : "…"));
    },
}).then(({version, style}) => {
    document.head.prepend(Object.assign(document.createElement("style"), {textContent: style}));
    status(`qdot ${version}, ready`);
    document.documentElement.dataset.ready = "yes";
}, failure => {
    status("not started");
    notice("The page could not be started: " + failure.message);
});

$("answers").innerHTML = INTRODUCTION;
scriptOfLink().catch(failure => {
    notice(failure.message);
    return null;
}).then(linked => {
    editor.setValue(linked ?? keptScript() ?? FIRST);
    editor.clearHistory();
    keepScript(editor);
    editor.focus();
});
globalThis.qdotPage = {editor, call: session.call, runAll};
