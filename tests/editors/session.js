/* session.js -- a person's first hour with the extension, step by step, in node: the extension itself, whose
 * commands and panels get a stub of VS Code, and the messages of an editor, to and from the real server.
 *
 *   node session.js EXTENSION QDOT [FOLDER]      prints TAP; FOLDER gets the pages of the panels
 */
"use strict";
const assert = require("assert");
const fs = require("fs");
const Module = require("module");
const os = require("os");
const path = require("path");
const {pathToFileURL} = require("url");
const {LanguageClient, Editor} = require("./editor");

const [extensionFolder, program, pages] = process.argv.slice(2);
const work = fs.mkdtempSync(path.join(os.tmpdir(), "qdot-session-"));

/* --- VS Code, as far as commands and panels know it ------------------------------------- */

const said = [], panels = [], commands = new Map(), settings = {path: "qdot"}, configured = [];
let chosen, cancelNext = null, client = null;

class Panel {
    constructor(title, options) {
        Object.assign(this, {title, options, webview: {html: ""}, closed: []});
        panels.push(this);
    }
    onDidDispose(heard) {
        this.closed.push(heard);
    }
    reveal() {}
    dispose() {
        panels.splice(panels.indexOf(this), 1);
        this.closed.forEach((heard) => heard());
    }
}

function cancellation() {
    const heard = [];
    const token = {isCancellationRequested: false, onCancellationRequested: (f) => {
        heard.push(f);
        return {dispose: () => {}};
    }};

    return {token, cancel: () => {
        token.isCancellationRequested = true;
        heard.forEach((f) => f());
    }};
}

const vscode = {
    ProgressLocation: {Notification: 15}, ViewColumn: {Beside: -2},
    window: {
        activeTextEditor: undefined,
        createOutputChannel: () => ({appendLine: () => {}, dispose: () => {}}),
        showErrorMessage: async (text) => {
            said.push(text);
            const answer = chosen;
            chosen = undefined;
            return answer;
        },
        showInformationMessage: async (text) => void said.push(text),
        withProgress: (options, task) => {
            const {token, cancel} = cancellation();

            if (cancelNext !== null)
                setTimeout(cancel, cancelNext);
            cancelNext = null;
            return task({report: () => {}}, token);
        },
        createWebviewPanel: (type, title, column, options) => new Panel(title, options)
    },
    workspace: {
        createFileSystemWatcher: () => ({dispose: () => {}}),
        getConfiguration: () => ({get: (name, otherwise) => settings[name] || otherwise}),
        onDidChangeConfiguration: (heard) => {
            configured.push(heard);
            return {dispose: () => {}};
        }
    },
    commands: {
        registerCommand: (name, act) => {
            commands.set(name, act);
            return {dispose: () => commands.delete(name)};
        },
        executeCommand: async (name, ...args) => void said.push(`${name} ${args}`)
    }
};

/* The extension's client is the one of editor.js, which the steps use, too. */
class Client extends LanguageClient {
    constructor(...args) {
        super(...args);
        client = this;
    }
}

const load = Module._load;
Module._load = function (name, ...rest) {
    return name === "vscode" ? vscode : name === "vscode-languageclient/node" ? {LanguageClient: Client}
        : load.call(this, name, ...rest);
};
const extension = require(path.resolve(extensionFolder, "extension.js"));

/* --- steps ------------------------------------------------------------------------------ */

const steps = [];

/* A step; `act` returns what is seen, and throws where it is not as it ought to be. Without a `vital` one
 * there is no sense in the others. */
function step(text, act, vital = false) {
    steps.push({text, act, vital});
}

async function main() {
    let failed = 0;

    console.log(`1..${steps.length}`);
    for (const [i, {text, act, vital}] of steps.entries()) {
        const began = Date.now();
        try {
            const seen = await act();

            console.log(`ok ${i + 1} - ${text}: ${String(seen).replace(/\n/g, " / ").slice(0, 300)} ` +
                        `(${Date.now() - began} ms)`);
        } catch (error) {
            failed++;
            console.log(`not ok ${i + 1} - ${text}\n# ${String(error.message).replace(/\n/g, "\n# ")}`);
            if (vital) {
                console.log("Bail out! there is no server");
                break;
            }
        }
    }
    fs.rmSync(work, {recursive: true});
    process.exit(failed > 0 ? 1 : 0);
}

let editor;

function open(name, text) {
    const file = path.join(work, name);

    fs.writeFileSync(file, text);
    editor = new Editor(client, pathToFileURL(file).href, text);
    vscode.window.activeTextEditor = {document: {languageId: "qdot", uri: {toString: () => editor.uri}}};
    return editor;
}

/* The messages of the diagnostics now. */
async function told() {
    return (await editor.diagnostics()).map((one) => one.message);
}

async function clean() {
    assert.deepStrictEqual(await told(), []);
    return "no diagnostic";
}

/* The only error, which holds the text and stands at the part of the script. */
async function onlyError(pattern, part) {
    const found = (await editor.diagnostics()).filter((one) => one.severity === 1);

    assert.strictEqual(found.length, 1, JSON.stringify(found));
    assert.match(found[0].message, pattern);
    const {start, end} = found[0].range;
    assert.strictEqual(editor.text.slice(editor.offset(start), editor.offset(end)), part);
    return found[0].message;
}

function hoverText(answer) {
    assert.ok(answer, "no answer");
    return answer.contents.value || answer.contents;
}

async function offers(...labels) {
    const found = (await editor.completions()).map((item) => item.label);

    for (const label of labels)
        assert.ok(found.includes(label), `${label} is not among ${found.slice(0, 30)}`);
    return found.slice(0, 12).join(" ");
}

/* Run a command of the extension; its panel, by a part of its title. */
async function panelOf(command, title) {
    await commands.get(command)();
    const panel = panels.find((one) => one.title.includes(title));

    assert.ok(panel, `no panel ${title} among ${panels.map((one) => one.title)}; ${said.slice(-1)}`);
    const html = panel.webview.html;
    assert.match(html, /Content-Security-Policy" content="default-src 'none'/);
    if (pages) {
        fs.mkdirSync(pages, {recursive: true});
        fs.writeFileSync(path.join(pages, `${command}.html`), html);
    }
    return panel;
}

function fakeProgram(name, text) {
    const file = path.join(work, name);

    fs.writeFileSync(file, text, {mode: 0o755});
    return file;
}

/* --- the program is not there, or is another --------------------------------------------- */

step("a program that is nowhere", async () => {
    settings.path = path.join(work, "nowhere");
    chosen = "Open settings";
    await extension.activate({subscriptions: []});
    await new Promise(setImmediate);
    assert.match(said[0], /is not found\. Install qdot, or set qdot\.path/);
    assert.strictEqual(said[1], "workbench.action.openSettings qdot.path");
    return said[0];
});
step("a file that is no program", async () => {
    settings.path = path.join(work, "text");
    fs.writeFileSync(settings.path, "no program\n", {mode: 0o644});
    await commands.get("qdot.restart")();
    assert.match(said[said.length - 1], /may not be carried out/);
    return said[said.length - 1];
});
step("another program", async () => {
    settings.path = "/bin/echo";
    await commands.get("qdot.restart")();
    assert.match(said[said.length - 1], /is not the program qdot/);
    return said[said.length - 1];
});
step("a program that is too old", async () => {
    settings.path = fakeProgram("old", "#!/bin/sh\necho 'qdot 0.0.9'\n");
    await commands.get("qdot.restart")();
    assert.match(said[said.length - 1], /version 0\.0\.9, which has no language server: a newer one is needed/);
    return said[said.length - 1];
});
step("a program whose server ends at once", async () => {
    settings.path = fakeProgram("ends", "#!/bin/sh\ncase $1 in --lsp) exit 2 ;; esac\necho 'qdot 0.1'; echo '  --lsp'\n");
    await commands.get("qdot.restart")();
    assert.match(said[said.length - 1], /did not start: it ended with 2/);
    return said[said.length - 1];
});
step("the setting is corrected: the server starts", async () => {
    settings.path = program;
    client = null;
    configured.forEach((heard) => heard({affectsConfiguration: (name) => name === "qdot.path"}));
    for (let i = 0; i < 200 && !(client && client.answer); i++)
        await new Promise((resolve) => setTimeout(resolve, 50));
    assert.strictEqual(client.answer.serverInfo.name, "qdot");
    return `${client.answer.serverInfo.name} ${client.answer.serverInfo.version}`;
}, true);
step("Run without a script in front", async () => {
    await commands.get("qdot.runFile")();
    assert.match(said[said.length - 1], /open a script/);
    return said[said.length - 1];
});

/* --- a scene is typed, with mistakes ------------------------------------------------------ */

step("an empty script", async () => {
    open("spring pendulum.lag", "");
    return clean();
});
step("a comment with signs beyond the 16 bits", async () => {
    editor.type("# a weight 🏋 on a spring\n");
    return clean();
});
step("a mistyped statement", async () => {
    editor.type("parm m, k, l > 0");
    return onlyError(/no statement begins with `parm`\nhint: .*`param`/, "parm");
});
step("its quick fix", async () => {
    const diagnostics = await editor.diagnostics();
    const actions = await client.sendRequest("textDocument/codeAction", {
        textDocument: {uri: editor.uri}, range: diagnostics[0].range, context: {diagnostics}});

    editor.applyWorkspace(actions[0].edit);
    assert.ok(editor.text.includes("\nparam m, k, l > 0"));
    await clean();
    return actions[0].title;
});
step("completion of a statement's word", async () => {
    editor.behind("l > 0");
    editor.type("\ncoo");
    return offers("coord");
});
step("it is accepted", async () => {
    await editor.accept("coord");
    editor.type(" r > 0, theta\n");
    assert.ok(editor.text.includes("coord r > 0, theta\n"));
    return clean();
});
step("options after the name of a particle", async () => {
    editor.type("particle bob ");
    return offers("mass");
});
step("a missing sign of multiplication", async () => {
    editor.type("mass m at (r sin(theta), -r*cos(theta))");
    const [error] = await editor.diagnostics();
    assert.match(error.message, /\*/);
    assert.strictEqual(editor.text.slice(editor.offset(error.range.start)).slice(0, 4), " sin");
    return error.message;
});
step("it is put in", async () => {
    editor.correct("r sin", "r*sin");
    return clean();
});
step("a name that is not declared", async () => {
    editor.behind("-r*cos(theta))");
    editor.type("\ngravity (0, -g)");
    return onlyError(/g/, "g");
});
step("it is declared", async () => {
    editor.correct("l > 0", "l > 0, g = 9.81");
    return clean();
});
step("an open bracket", async () => {
    editor.behind("(0, -g)");
    editor.type("\npotential k*(r - l");
    return onlyError(/`?\(`?/, "(");
});
step("it is closed", async () => {
    editor.type(")^2/2\n");
    return clean();
});
step("a misspelled option", async () => {
    editor.type("set m = 1, k = 40, l = 1\nstart r = 1.2, theta = 1\nrun 0..10 tolerance 1e-9");
    return onlyError(/tol/, "tolerance");
});
step("it is corrected", async () => {
    editor.correct("tolerance", "tol");
    return clean();
});
step("completion of options", async () => {
    editor.behind("1e-9");
    editor.type(" me");
    const seen = await offers("method");
    editor.replace(editor.cursor - 3, editor.cursor, "");
    return seen;
});
step("completion of declared names", async () => {
    editor.type("\nplot th");
    const seen = await offers("theta");
    await editor.accept("theta");
    return seen;
});
step("completion of a Greek letter", async () => {
    editor.type(", \\thet");
    const labels = (await editor.completions()).map((item) => item.label);
    assert.ok(labels.some((label) => /θ|\\theta/.test(label)), labels.join(" "));
    editor.replace(editor.cursor - 5, editor.cursor, "θ");
    editor.type("'\n");
    await clean();
    return labels.join(" ");
});
step("completion within brackets", async () => {
    editor.type("check eom[");
    const seen = await offers("theta", "r");
    editor.replace(editor.cursor - 4, editor.cursor, "conserved ");
    return seen;
});
step("completion of a value", async () => {
    editor.type("ener");
    const seen = await offers("energy");
    await editor.accept("energy");
    editor.type("\n");
    await clean();
    return seen;
});

/* --- what things mean ----------------------------------------------------------------------- */

step("hover over a statement's word", async () => {
    const text = hoverText(await editor.behind("partic").ask("hover"));
    assert.match(text, /particle NAME mass M at R/);
    return text;
});
step("hover over a parameter", async () => {
    const text = hoverText(await editor.behind("-g").ask("hover"));
    assert.match(text, /9\.81|param/);
    return text;
});
step("hover over a coordinate", async () => {
    const text = hoverText(await editor.behind("sin(the").ask("hover"));
    assert.match(text, /coord/);
    return text;
});
step("hover over a value shows its formula", async () => {
    editor.behind("conserved energy\n");
    editor.type("T\n");
    const text = hoverText(await editor.behind("energy\nT").ask("hover"));
    assert.match(text, /θ̇|theta'/);
    return text;
});
step("hover over a function", async () => {
    const text = hoverText(await editor.behind("r*si").ask("hover"));
    assert.match(text, /sine/);
    return text;
});
step("hover over a number", async () => {
    assert.strictEqual(await editor.behind("1e-").ask("hover"), null);
    return "nothing";
});
step("signature of a function", async () => {
    editor.behind("energy\nT\n");
    editor.type("diff(T, ");
    const help = await editor.ask("signatureHelp");
    assert.match(help.signatures[0].label, /diff\(/);
    editor.replace(editor.cursor - 8, editor.cursor, "");
    return help.signatures[0].label;
});
step("definition", async () => {
    const answer = await editor.behind("sin(th").ask("definition");
    const place = Array.isArray(answer) ? answer[0] : answer;
    const start = editor.offset((place.range || place.targetSelectionRange).start);
    assert.strictEqual(editor.text.slice(start - 7, start + 5), "r > 0, theta");
    return "coord r > 0, theta";
});
step("references, with θ for theta", async () => {
    const found = await editor.ask("references", {context: {includeDeclaration: true}});
    const words = found.map((one) => editor.text.slice(editor.offset(one.range.start), editor.offset(one.range.end)));
    assert.ok(words.every((word) => /^(theta|θ)/.test(word)) && words.includes("θ") && words.length === 6, words.join(" "));
    return words.join(" ");
});
step("highlights of the same name", async () => {
    const found = await editor.ask("documentHighlight");
    assert.strictEqual(found.length, 6);
    return found.length;
});
step("rename a parameter", async () => {
    editor.behind("k*(r");
    editor.cursor -= 3;
    const answer = await editor.ask("rename", {newName: "stiffness_k"});
    assert.strictEqual(editor.applyWorkspace(answer), 3);
    assert.ok(editor.text.includes("param m, stiffness_k, l") && editor.text.includes("set m = 1, stiffness_k = 40"));
    await clean();
    return "3 places";
});
step("rename a label", async () => {
    const answer = await editor.behind("particle bo").ask("rename", {newName: "weight"});
    editor.applyWorkspace(answer);
    assert.ok(editor.text.includes("particle weight mass m"));
    return clean();
});
step("rename to what is no name", async () => {
    await assert.rejects(editor.behind("particle wei").ask("rename", {newName: "2 b"}), (error) => {
        said.push(error.message);
        return error.message.length > 10;
    });
    return said[said.length - 1];
});
step("rename to a word of the language", async () => {
    await assert.rejects(editor.behind("sin(the").ask("rename", {newName: "pi"}), (error) => {
        said.push(error.message);
        return /pi/.test(error.message);
    });
    return said[said.length - 1];
});
step("outline", async () => {
    const names = (await editor.ask("documentSymbol")).map((symbol) => symbol.name);
    for (const name of ["m", "r", "theta", "weight"])
        assert.ok(names.includes(name), names.join(" "));
    return names.join(" ");
});
step("folding of a block", async () => {
    editor.cursor = editor.text.length;
    editor.type("{\n    print j\n    print 2*j\n} for j = 1..2\n");
    const ranges = await editor.ask("foldingRange");
    assert.ok(ranges.some((range) => range.endLine - range.startLine >= 2), JSON.stringify(ranges));
    return ranges.length;
});
step("formatting", async () => {
    editor.correct("set m = 1, stiffness_k = 40", "set   m=1 ,stiffness_k =   40");
    const edits = await editor.ask("formatting", {options: {tabSize: 4, insertSpaces: true}});
    editor.apply(edits);
    assert.ok(editor.text.includes("set m = 1, stiffness_k = 40"), editor.text);
    await clean();
    return `${edits.length} edits`;
});
step("formatting once more changes nothing", async () => {
    const before = editor.text;
    editor.apply(await editor.ask("formatting", {options: {tabSize: 4, insertSpaces: true}}) || []);
    assert.strictEqual(editor.text, before);
    return "the same";
});
step("code lenses", async () => {
    const lenses = await editor.ask("codeLens");
    const titles = lenses.map((lens) => lens.command.title);
    assert.ok(lenses.some((lens) => lens.command.command === "qdot.run"), titles.join());
    return titles.join(", ");
});

/* --- pages of panels ---------------------------------------------------------------------- */

step("what qdot writes is placed as it is, and nothing else is markup", async () => {
    const {answersPage, wholePage} = require(path.resolve(extensionFolder, "page.js"));
    const evil = "<script>alert(1)</script>\" onerror=\"alert(2)";
    const html = answersPage(evil, {html: "<math><mi>x</mi></math>", style: ".qdot p { margin: 0; }"}, [{name: evil, data: evil}]);
    const old = answersPage(evil, {text: evil, error: evil}, []);

    for (const one of [html, old])
        assert.doesNotMatch(one, /<script|<[^>]* onerror="/);
    assert.match(html, /<math><mi>x<\/mi><\/math>/);
    assert.match(html, /[.]qdot p /);
    assert.match(old, /<pre class="error">&lt;script/);
    const page = wholePage("<!DOCTYPE html><html><head></head><body><script>1</script></body></html>");
    assert.match(page, /<head><meta http-equiv="Content-Security-Policy"[^>]*><\/head><body><script nonce="/);
    return `${html.length} characters`;
});

/* --- it is run -------------------------------------------------------------------------------- */

step("Run", async () => {
    const {webview: {html}} = await panelOf("qdot.runFile", "spring pendulum.lag");
    assert.match(html, /proved/);
    assert.match(html, /run1: t = 0\.\.10|run run1/);
    return /run1[^\n]*/.exec(html)[0];
});
step("Run by the code lens", async () => {
    const count = panels.length;
    await client.options.middleware.executeCommand("qdot.run", [editor.uri], () => assert.fail());
    assert.strictEqual(panels.length, count);
    return "the same panel";
});
step("what is not saved is run", async () => {
    editor.cursor = editor.text.length;
    editor.type("print \"not saved\"\n");
    const {webview: {html}} = await panelOf("qdot.runFile", "spring pendulum.lag");
    assert.match(html, /not saved/);
    return "printed";
});
step("Show equations", async () => {
    const {webview: {html}} = await panelOf("qdot.showEquations", "spring pendulum.lag");
    assert.match(html, /<math|theta&#39;&#39;|θ̈/);
    return /<math/.test(html) ? "typeset" : "plain";
});
step("Plot", async () => {
    const {webview: {html}} = await panelOf("qdot.plotFile", "spring pendulum.lag");
    assert.match(html, /<img[^>]*src="data:image\/svg\+xml;base64,/);
    return "a figure";
});
step("Animate", async () => {
    editor.type("animate to \"swing.html\"\n");
    const panel = await panelOf("qdot.animateFile", ": animation");
    assert.match(panel.webview.html, /script-src 'nonce-[^']+'/);
    assert.ok(panel.options.enableScripts);
    assert.ok(!fs.existsSync(path.join(work, "swing.html")), "the file was written");
    panel.dispose();
    return panel.title;
});
step("Report", async () => {
    const panel = await panelOf("qdot.reportFile", ": report");
    assert.match(panel.webview.html, /<math/);
    panel.dispose();
    return panel.title;
});
step("a script that fails as it runs", async () => {
    editor.type("run 0..1 with m = -1\n");
    const {webview: {html}} = await panelOf("qdot.runFile", "spring pendulum.lag");
    assert.match(html, /class="error"[^]*error:/);
    editor.correct("run 0..1 with m = -1\n", "");
    return /error:[^\n]*/.exec(html)[0];
});
step("a long run is cancelled", async () => {
    const began = Date.now();
    editor.type("run 0..1e9 tol 1e-14\n");
    cancelNext = 1500;
    await commands.get("qdot.runFile")();
    assert.ok(Date.now() - began < 8000, `${Date.now() - began} ms`);
    editor.correct("run 0..1e9 tol 1e-14\n", "");
    return "stopped";
});
step("the server goes on", async () => {
    await clean();
    return offers("param");
});
step("200 keys in a row", async () => {
    const began = Date.now();
    for (let i = 0; i < 10; i++)
        editor.type(`x${i}_is_12345 = ${i}*m\n`);
    await clean();
    assert.ok(Date.now() - began < 10000);
    return `${Date.now() - began} ms`;
});
step("another script, which includes a file", async () => {
    fs.writeFileSync(path.join(work, "constants.lag"), "param G = 6.674e-11\n");
    open("planet.lag", "include \"constants.lag\"\nparam M > 0\nprint G*M\n");
    await clean();
    const {webview: {html}} = await panelOf("qdot.runFile", "planet.lag");
    assert.match(html, /M/);
    return `${panels.length} panels`;
});
step("the server is killed: Restart brings it back", async () => {
    const before = client;
    before.process.kill("SIGKILL");
    await before.ended;
    before.stop = async () => {};
    await commands.get("qdot.restart")();
    assert.notStrictEqual(client, before);
    open("again.lag", "coord x\nparticle b mass 1 at (x, 0)\nprint y\n");
    return onlyError(/y/, "y");
});
step("the window is closed", async () => {
    const last = client;
    await extension.deactivate();
    assert.strictEqual(await last.ended, 0);
    return "the server ended with 0";
});

main();
