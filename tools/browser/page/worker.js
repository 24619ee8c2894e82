/* worker.js -- a session of qdot in a thread of its own: the page stays alive while it computes.
 *
 * Messages from the page: {id, kind, ...}; each gets one {id, kind: "end", ...}, answers before it as they come.
 *   ask       text, line (its first in the source), source (what errors call it), fresh (from the beginning): statement by
 *             statement, each with a message {kind: "begin", line, text} and, when it was carried out, {kind: "piece", line,
 *             text, answers}
 *   complete  text, cursor               explain  text, cursor
 *   write     name, bytes: a file that statements read      read  name: one that they wrote
 */
"use strict";

const DISPLAY = 5, JSON_NOTATION = 4;
let qdot = null, session = 0, table = null;

function allocate(text) {
    const n = qdot.lengthBytesUTF8(text) + 1, at = qdot._malloc(n);
    qdot.stringToUTF8(text, at, n);
    return at;
}

/* The text that a function writes through its argument `char **`. */
function taken(slot) {
    const at = qdot.HEAPU32[slot >> 2], text = at ? qdot.UTF8ToString(at) : "";
    if (at)
        qdot._qdot_string_free(at);
    return text;
}

function begin() {
    if (session)
        qdot._qdot_system_free(session);
    const slot = qdot._malloc(4);
    qdot._qdot_system_new(slot);
    session = qdot.HEAPU32[slot >> 2];
    qdot._free(slot);
    if (qdot._qdot_system_progress) {
        table = table || qdot.addFunction((data, what, done, left) =>
            postMessage({kind: "progress", what: qdot.UTF8ToString(what), done, left}), "viidd");
        qdot._qdot_system_progress(session, table, 0);
    }
}

/* The pieces of a text that can be carried out one after another: lines, together where one is not finished. */
function* pieces(text) {
    const lines = text.split("\n");
    for (let i = 0; i < lines.length;) {
        let piece = lines[i], n = 1;
        const unfinished = () => {
            const at = allocate(piece), open = qdot._qdot_text_unfinished(at);
            qdot._free(at);
            return open;
        };
        while (i + n < lines.length && unfinished())
            piece += "\n" + lines[i + n++];
        if (piece.trim() !== "" && !/^\s*#[^\n]*$/.test(piece))
            yield {line: i, text: piece};
        i += n;
    }
}

/* Carry out a piece that begins in line `line` of the script, or of what was typed at the prompt; false: it failed. Empty lines
 * before it make the lines right that the library names. */
function askPiece(id, line, piece, source) {
    postMessage({id, kind: "begin", line, text: piece});
    const name = allocate(source);
    qdot._qdot_system_source(session, name);
    qdot._free(name);
    const text = allocate("\n".repeat(line - 1) + piece), slot = qdot._malloc(4);
    qdot.HEAPU32[slot >> 2] = 0;
    const result = qdot._qdot_system_ask(session, text, DISPLAY, slot);
    const answers = taken(slot).split("\n").filter(answer => answer !== "").map(answer => JSON.parse(answer));
    qdot._free(text);
    qdot._free(slot);
    if (result !== 0 && !answers.some(a => a.kind === "error"))
        answers.push({kind: "error", line, column: 0, message: qdot.UTF8ToString(qdot._qdot_system_error(session))});
    postMessage({id, kind: "piece", line, text: piece, answers});
    return result === 0;
}

const calls = {
    ask({id, text, line, fresh, source = "script"}) {
        if (fresh)
            begin();
        let good = true;
        for (const piece of pieces(text))
            if (!(good = askPiece(id, line + piece.line, piece.text, source)))
                break;
        return {good};
    },
    complete({text, cursor}) {
        const before = new TextEncoder().encode(text.slice(0, cursor)).length;
        const at = allocate(text), start = qdot._malloc(8);
        qdot.HEAPU32[(start >> 2) + 1] = 0;
        const result = qdot._qdot_system_complete(session, at, before, start, start + 4);
        const words = taken(start + 4), from = qdot.HEAPU32[start >> 2];
        qdot._free(at);
        qdot._free(start);
        return result !== 0 ? {words: []} : {words: words.split("\n").filter(w => w !== ""),
                                             start: new TextDecoder().decode(new TextEncoder().encode(text).slice(0, from)).length};
    },
    explain({text, cursor}) {
        if (!qdot._qdot_system_explain)
            return {};
        const at = allocate(text), slot = qdot._malloc(4);
        qdot.HEAPU32[slot >> 2] = 0;
        const result = qdot._qdot_system_explain(session, at, new TextEncoder().encode(text.slice(0, cursor)).length, JSON_NOTATION, slot);
        const said = taken(slot);
        qdot._free(at);
        qdot._free(slot);
        return {said: result === 0 && said !== "" ? JSON.parse(said) : null};
    },
    write({name, bytes}) {
        qdot.FS.writeFile(name, bytes);
        return {};
    },
    read({name}) {
        return {bytes: qdot.FS.readFile(name)};
    },
};

const waiting = [];

function serve(message) {
    try {
        postMessage({id: message.id, kind: "end", ...calls[message.kind](message)});
    } catch (failure) { /* the library never unwinds: its memory is as it was left, not to be used again */
        postMessage({id: message.id, kind: "lost", message: String(failure && failure.message || failure)});
    }
}

onmessage = event => qdot ? serve(event.data) : waiting.push(event.data);

/* qdotModule comes from qdot.js, qdotBytes from the page. */
qdotModule({wasmBinary: qdotBytes}).then(module => {
    qdot = module;
    begin();
    postMessage({kind: "ready", version: qdot.UTF8ToString(qdot._qdot_version()), style: qdot.UTF8ToString(qdot._qdot_display_style())});
    waiting.splice(0).forEach(serve);
}, failure => postMessage({kind: "lost", message: String(failure)}));
