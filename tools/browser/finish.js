/* finish.js ROOT OUT -- what is made of the files in OUT: the examples, the files for a page that is opened without a
 * server, the service worker with the version of what it keeps, and their sizes. */
"use strict";

const fs = require("fs"), path = require("path"), zlib = require("zlib"), crypto = require("crypto");
const [root, out] = process.argv.slice(2);
const read = name => fs.readFileSync(path.join(out, name));

/* --- examples: those that need no other program, each with the files that it names ------------- */

const folder = path.join(root, "examples"), names = fs.readdirSync(folder);
const examples = names.filter(name => name.endsWith(".lag")).sort().map(name => {
    const text = fs.readFileSync(path.join(folder, name), "utf8"), files = {};
    for (const other of names)
        if (other !== name && text.includes(`"${other}"`))
            files[other] = fs.readFileSync(path.join(folder, other), "utf8");
    return {name, title: name.replace(/\.lag$/, "").replace(/-/g, " "), text, files};
});
fs.writeFileSync(path.join(out, "examples.js"), "globalThis.qdotExamples = " + JSON.stringify(examples) + ";\n");

/* --- for file:// -------------------------------------------------------------------------------- */

fs.writeFileSync(path.join(out, "offline.js"), "globalThis.qdotOffline = " + JSON.stringify({
    source: read("qdot.js").toString() + "\n" + read("worker.js").toString(),
    wasm: zlib.gzipSync(read("qdot.wasm"), {level: 9}).toString("base64"),
}) + ";\n");

/* --- the service worker ---------------------------------------------------------------------------- */

const kept = ["index.html", "page.css", "bundle.js", "worker.js", "qdot.js", "qdot.wasm", "examples.js", "icon.svg"];
const version = crypto.createHash("sha256");
kept.forEach(name => version.update(read(name)));
fs.writeFileSync(path.join(out, "service.js"), fs.readFileSync(path.join(__dirname, "page", "service.js"), "utf8")
    .replace("@version@", version.digest("hex").slice(0, 12)));

/* --- sizes ---------------------------------------------------------------------------------------- */

const size = {};
for (const name of fs.readdirSync(out).sort()) {
    const bytes = read(name);
    size[name] = [bytes.length, zlib.gzipSync(bytes, {level: 9}).length, zlib.brotliCompressSync(bytes).length];
}
const sum = (list, k) => list.reduce((all, name) => all + (size[name] || [0, 0, 0])[k], 0);
const line = (name, bytes) => console.log(name.padEnd(28) + bytes.map(n => (n / 1e6).toFixed(3).padStart(9)).join(""));
console.log("".padEnd(28) + ["MB", "gzip -9", "brotli"].map(t => t.padStart(9)).join(""));
Object.keys(size).forEach(name => line(name, size[name]));
line("loaded from a server", [0, 1, 2].map(k => sum([...kept, "service.js"], k)));
line("opened as a file", [0, 1, 2].map(k => sum(["index.html", "page.css", "bundle.js", "offline.js", "examples.js", "icon.svg"], k)));
line("whole folder", [0, 1, 2].map(k => sum(Object.keys(size), k)));
