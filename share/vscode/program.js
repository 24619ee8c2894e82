/* program.js -- finds the program qdot, and whether it has a language server. */
"use strict";
const {execFile} = require("child_process");

/* What the program prints; null where it cannot be started. */
function ask(path, option) {
    return new Promise((resolve) => {
        execFile(path, [option], {timeout: 20000, windowsHide: true}, (error, printed) => {
            resolve(error ? {code: error.code, printed} : {code: 0, printed});
        });
    });
}

/* {path, version} of the program, or {problem}, a sentence for who wants to use it. */
async function findProgram(path) {
    const asked = await ask(path, "--version");

    if (asked.code === "ENOENT")
        return {problem: `The program ${path} is not found. Install qdot, or set qdot.path to where it is.`};
    if (asked.code === "EACCES")
        return {problem: `${path} may not be carried out. Set qdot.path to the program qdot.`};
    const version = /^qdot\b\D*([0-9.]+\S*)/.exec(asked.printed || "");
    if (asked.code !== 0 || version === null)
        return {problem: `${path} is not the program qdot. Set qdot.path to where it is.`};
    const help = await ask(path, "--help");
    if (!/\s--lsp\b/.test(help.printed || ""))
        return {problem: `${path} is version ${version[1]}, which has no language server: a newer one is needed.`};
    return {path, version: version[1]};
}

module.exports = {findProgram};
