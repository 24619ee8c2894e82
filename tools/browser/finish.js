/* finish.js ROOT MODULE OUT -- the files in OUT that are made of others: the examples; the module in the folder MODULE with the
 * worker that calls it, as one script; the service worker with the version of what it keeps; and their sizes. */
"use strict";

const fs = require("fs"), path = require("path"), zlib = require("zlib"), crypto = require("crypto");
const [root, from, out] = process.argv.slice(2);
const read = (name, folder = out) => fs.readFileSync(path.join(folder, name));

/* --- examples, each with the data and scripts that it names ------------------------------------- */

const folder = path.join(root, "examples"), names = fs.readdirSync(folder);
const examples = names.filter(name => name.endsWith(".lag")).sort().map(name => {
    const text = fs.readFileSync(path.join(folder, name), "utf8"), files = {};
    for (const other of names)
        if (other !== name && /\.(csv|lag|txt)$/.test(other) && text.includes(`"${other}"`))
            files[other] = fs.readFileSync(path.join(folder, other), "utf8");
    return {name, title: name.replace(/\.lag$/, "").replace(/-/g, " "), text, files};
});
fs.writeFileSync(path.join(out, "examples.js"), "globalThis.qdotExamples = " + JSON.stringify(examples) + ";\n");

/* --- the module --------------------------------------------------------------------------------- */

fs.writeFileSync(path.join(out, "module.js"), "globalThis.qdotModuleFiles = " + JSON.stringify({
    source: read("qdot.js", from).toString() + "\n" + read("worker.js", path.join(__dirname, "page")).toString(),
    wasm: zlib.gzipSync(read("qdot.wasm", from), {level: 9}).toString("base64"),
}) + ";\n");

/* --- the service worker ---------------------------------------------------------------------------- */

const kept = ["index.html", "page.css", "bundle.js", "module.js", "examples.js", "icon.svg", "math.woff2"];
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
const line = (name, bytes) => console.log(name.padEnd(28) + bytes.map(n => (n / 1e6).toFixed(3).padStart(9)).join(""));
console.log("".padEnd(28) + ["MB", "gzip -9", "brotli"].map(t => t.padStart(9)).join(""));
Object.keys(size).forEach(name => line(name, size[name]));
line("all", [0, 1, 2].map(k => Object.values(size).reduce((all, bytes) => all + bytes[k], 0)));
