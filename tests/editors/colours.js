/* colours.js -- whether an editor's colours of scripts are those of the program.
 *
 *   node colours.js codemirror|textmate FILE KINDS SCRIPT...
 *
 * FILE is the mode or the grammar that make has written, KINDS what kinds.py prints of the scripts.
 * Prints the lines that differ, of each the program's letters and the editor's, and ends with 1 if there
 * are any.
 */
"use strict";
const fs = require("fs");

/* A line's text as the modes of CodeMirror read it. */
class Stream {
    constructor(text) {
        this.string = text;
        this.pos = 0;
    }
    sol() {
        return this.pos === 0;
    }
    next() {
        return this.string.charAt(this.pos++);
    }
    match(pattern) {
        const found = this.string.slice(this.pos).match(pattern);

        if (!found || found.index > 0)
            return null;
        this.pos += found[0].length;
        return found;
    }
}

/* The letters of a text's lines, by the mode. */
function codemirror(file) {
    const parser = require(file).parser;
    const letters = {keyword: "W", builtin: "N", number: "0", string: "S", comment: "C", error: "X"};

    return (text) => {
        const state = parser.startState();

        return text.split("\n").map((line) => {
            const stream = new Stream(line);
            let kinds = "";

            if (line === "")
                parser.blankLine(state);
            while (stream.pos < line.length) {
                const start = stream.pos, style = parser.token(stream, state);

                if (stream.pos === start)
                    throw new Error("no progress at: " + line.slice(start));
                kinds += (letters[style] || "P").repeat(Buffer.byteLength(line.slice(start, stream.pos)));
            }
            return kinds;
        });
    };
}

/* The letters of a text's lines, by the grammar, as VS Code's own two libraries read it. */
async function textmate(file) {
    const {Registry, INITIAL, parseRawGrammar} = require("vscode-textmate");
    const oniguruma = require("vscode-oniguruma");
    const letters = [[/\bcomment\b/, "C"], [/\bstring\b/, "S"], [/constant\.numeric/, "0"], [/invalid/, "X"],
                     [/keyword\.(control|other)/, "W"], [/support|constant\.language/, "N"]];

    await oniguruma.loadWASM(fs.readFileSync(require.resolve("vscode-oniguruma/release/onig.wasm")).buffer);
    const registry = new Registry({
        onigLib: Promise.resolve({
            createOnigScanner: (patterns) => new oniguruma.OnigScanner(patterns),
            createOnigString: (text) => new oniguruma.OnigString(text)
        }),
        loadGrammar: async () => parseRawGrammar(fs.readFileSync(file, "utf8"), file)
    });
    const grammar = await registry.loadGrammar("source.qdot");

    return (text) => {
        let state = INITIAL;

        return text.split("\n").map((line) => {
            const read = grammar.tokenizeLine(line, state);

            state = read.ruleStack;
            return read.tokens.map((token) => {
                const scopes = token.scopes.slice(1).join(" ");
                const found = letters.find(([pattern]) => pattern.test(scopes));

                return (found ? found[1] : "P")
                    .repeat(Buffer.byteLength(line.slice(token.startIndex, token.endIndex)));
            }).join("");
        });
    };
}

async function main(kind, file, kinds, scripts) {
    const lines = await (kind === "textmate" ? textmate : codemirror)(fs.realpathSync(file));
    const expected = fs.readFileSync(kinds, "latin1").split("\n");
    let bytes = 0, wrong = 0;

    scripts.forEach((script, k) => {
        const text = fs.readFileSync(script, "utf8");
        let at = 0;

        lines(text).forEach((seen, n) => {
            const line = text.split("\n")[n];
            const told = expected[k].slice(at, at + seen.length);

            at += seen.length + 1;
            bytes += seen.length;
            if (seen !== told || seen.includes("X")) {
                console.log(`${script}:${n + 1}\n${line}\n${told}\n${seen}`);
                wrong++;
            }
        });
    });
    console.log(`${bytes} bytes of ${scripts.length} scripts, ${wrong} lines differ`);
    process.exit(wrong > 0 || bytes === 0 ? 1 : 0);
}

const [kind, file, kinds, ...scripts] = process.argv.slice(2);

main(kind, file, kinds, scripts);
