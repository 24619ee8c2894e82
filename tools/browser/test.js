/* test.js ROOT PROGRAM OUT -- scripts in the page, in headless Chromium, against the native program, number by number. */
"use strict";

const fs = require("fs"), os = require("os"), path = require("path"), http = require("http");
const {spawnSync} = require("child_process");
const {chromium} = require("playwright-core");
const {ready} = require("./test-tools.js"), testPage = require("./test-page.js");
const [root, program, out] = process.argv.slice(2);

let passed = 0, failed = 0;

function expect(good, what) {
    if (good)
        passed++;
    else if (++failed <= 40)
        console.log("not ok: " + what);
}

/* --- scripts ---------------------------------------------------------------------------------- */

/* What is typed in the conversations of the tutorial, as one script. */
function tutorial() {
    const plain = line => line.replace(/@\{/g, "{").replace(/@\}/g, "}").replace(/@@/g, "@");
    const typed = fs.readFileSync(path.join(root, "doc/tutorial.texi"), "utf8").split("\n")
        .map(line => /^qdot \d+> (.*)/.exec(line)).filter(found => found && !/^(quit|exit)/.test(found[1]));
    return typed.map(found => plain(found[1])).join("\n") + "\n";
}

const examples = ["double-pendulum", "kepler", "bead-on-helix", "coupled-oscillators", "foucault", "heavy-top", "henon-heiles", "routh",
    "spherical-pendulum", "rotating-hoop", "swinging-atwood", "bouncing-ball", "lagrange-points", "torus-geodesic"];

function scripts() {
    return [{name: "tutorial", text: tutorial()}, ...examples.filter(name => fs.existsSync(path.join(root, "examples", name + ".lag")))
        .map(name => ({name, text: fs.readFileSync(path.join(root, "examples", name + ".lag"), "utf8")}))];
}

/* --- the native answers ----------------------------------------------------------------------------- */

function nativeAnswers(text) {
    const folder = fs.mkdtempSync(path.join(os.tmpdir(), "qdot-browser-"));
    for (const name of fs.readdirSync(path.join(root, "examples")).filter(n => n.endsWith(".csv")))
        fs.copyFileSync(path.join(root, "examples", name), path.join(folder, name));
    fs.writeFileSync(path.join(folder, "script.lag"), text);
    const done = spawnSync(program, ["--json", "script.lag"], {cwd: folder, encoding: "utf8", maxBuffer: 1 << 28, env: {...process.env, PATH: "/"}});
    fs.rmSync(folder, {recursive: true});
    return done.stdout.split("\n").filter(l => l !== "").map(l => JSON.parse(l));
}

/* --- comparison ---------------------------------------------------------------------------------------- */

const apart = new Set(["figure", "page", "file", "notice", "done"]); /* what a page shows and a program writes to a file */
const unlike = new Set(["cpu", "cpu_total", "steps", "rejected", "evals", "jacobians", "factorizations", "statement", "line", "file",
    "typeset", "mathml", "text", "drifts", "energy_drift", "constraint_drift", "constraints"]);
/* A plan states what its method costs, which here is without machine code. */
const isPlan = a => a.kind === "text" && a.name === "plan";
/* What the page has in words alone. */
const isWorded = a => a.kind === "expr" && /^(cyclic\[|reactions$)/.test(a.name);
const isError = key => /error/.test(key);

/* Two numbers are equal within the errors that both state, or twelve digits where they state none. */
function compareNumber(a, b, error, what) {
    const bound = Math.max(3 * (error || 0), 1e-11 * Math.max(1, Math.abs(a)));
    expect(Math.abs(a - b) <= bound, `${what}: ${a} in the program, ${b} in the page`);
}

function compare(a, b, error, what) {
    if (typeof a === "number" && typeof b === "number")
        return compareNumber(a, b, error, what);
    if (typeof a === "string" && typeof b === "string" && /^-?\d+\.\d+(e[-+]\d+)?$/.test(a) && isFinite(Number(b)))
        return compareNumber(Number(a), Number(b), error, what); /* a number of a run within a claim */
    if (Array.isArray(a) && Array.isArray(b)) {
        expect(a.length === b.length, what + ": lengths differ");
        return a.forEach((x, i) => compare(x, b[i], Array.isArray(error) ? error[i] : error, `${what}[${i}]`));
    }
    if (a !== null && typeof a === "object" && b !== null && typeof b === "object")
        return Object.keys(a).filter(key => !unlike.has(key)).forEach(key => isError(key)
            ? expect((a[key] === null) === (b[key] === null), `${what}.${key}: known in one, unknown in the other`)
            : compare(a[key], b[key], ownError(a, b, key) || error, `${what}.${key}`));
    expect(a === b, `${what}: ${JSON.stringify(a)} in the program, ${JSON.stringify(b)} in the page`);
}

/* The errors that both answers state of what stands under `key`, added. */
function ownError(a, b, key) {
    const name = {value: "error", values: "errors", state: "error"}[key];
    if (!name || a[name] == null || b[name] == null)
        return 0;
    if (Array.isArray(a[name]))
        return a[name].map((e, i) => (e || 0) + (b[name][i] || 0));
    const scale = key === "state" ? Math.max(1, ...Object.values(a.state).map(v => Math.abs(v || 0))) : 1;
    return (a[name] + b[name]) * scale;
}

/* --- the page --------------------------------------------------------------------------------------------- */

const types = {".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml", ".wasm": "application/wasm"};

function serve() {
    const server = http.createServer((request, response) => {
        const name = path.join(out, new URL(request.url, "http://x").pathname.replace(/\/$/, "/index.html"));
        fs.readFile(name, (missing, bytes) => {
            response.writeHead(missing ? 404 : 200, {"Content-Type": types[path.extname(name)] || "application/octet-stream"});
            response.end(bytes);
        });
    });
    return new Promise(good => server.listen(0, "127.0.0.1", () => good(server)));
}

/* The answers of a script in the page's session, from the beginning. */
function pageAnswers(page, text) {
    return page.evaluate(async script => {
        const all = [];
        const end = await qdotPage.call({kind: "ask", text: script, line: 1, fresh: true}, data => all.push(...(data.answers || [])));
        return {all, end};
    }, text);
}

async function main() {
    const server = await serve(), address = `http://127.0.0.1:${server.address().port}/`;
    /* Without a sandbox headless Chromium starts the process of a sandboxed frame only now and then: frames stay in the page's. */
    const browser = await chromium.launch({executablePath: process.env.CHROMIUM || "/usr/bin/chromium", args: ["--no-sandbox", "--disable-gpu",
        "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-features=IsolateSandboxedIframes"]});
    const context = await browser.newContext(), page = await context.newPage();
    page.on("pageerror", e => expect(false, "the page: " + e.message));

    const begun = Date.now();
    await page.goto(address);
    await ready(page);
    const {all: first} = await pageAnswers(page, "coord x\nparticle p mass 1 at (x, 0)\nT\n");
    const seconds = (Date.now() - begun) / 1000;
    expect(first.some(a => a.kind === "expr" && a.plain === "1/2*x'^2"), "the first answer");
    expect(seconds < 2, `the first answer came after ${seconds} s`);
    console.log(`first answer after ${seconds} s`);

    for (const script of scripts()) {
        const before = [passed, failed], start = Date.now();
        const native = nativeAnswers(script.text).filter(a => !apart.has(a.kind) && !isWorded(a));
        const took = Date.now() - start, {all, end} = await pageAnswers(page, script.text);
        const here = all.filter(a => !apart.has(a.kind));
        expect(end.kind === "end", `${script.name}: the session was lost: ${end.message}`);
        expect(native.length === here.length, `${script.name}: ${native.length} answers in the program, ${here.length} in the page`);
        native.slice(0, here.length).forEach((a, i) => isPlan(a) || compare(a, here[i], 0, `${script.name}, answer ${i + 1} (${a.name || a.kind})`));
        console.log(`${script.name}: ${passed - before[0]} equal, ${failed - before[1]} not; ${took} ms natively, ` +
                    `${Date.now() - start - took} ms in the page`);
        if (end.kind === "lost") {
            await page.reload();
            await ready(page);
        }
    }

    /* the page itself */
    await page.evaluate(() => qdotPage.editor.setValue("coord x\nparticle p mass 1 at (x, 0)\nspring s between p, (0, 0) stiffness 1\n" +
                                                        "start x = 1\nrun 0..10\nplot x\nanimate\nplt x\n"));
    await page.keyboard.press("Control+Enter");
    await page.waitForSelector(".error", {timeout: 60000});
    expect(await page.locator(".figure svg").count() > 0, "a figure is shown");
    expect(await page.locator("iframe").count() === 1, "an animation is shown");
    expect((await page.textContent(".error")).includes("did you mean"), "an error has its hint");

    await testPage(context, address, expect);

    /* without network: the server is gone */
    await page.evaluate(() => navigator.serviceWorker.ready.then(() => 0));
    server.closeAllConnections();
    server.close();
    await page.reload();
    await ready(page).then(() => expect(true, ""), () => expect(false, "the page loads without network"));
    const {all: offline} = await pageAnswers(page, "print 2*21");
    expect(offline.some(a => a.text === "42"), "answers without network");

    /* without server */
    const file = await context.newPage();
    await file.goto("file://" + path.resolve(out, "index.html"));
    await ready(file).then(() => expect(true, ""), () => expect(false, "the page opens as a file"));

    await browser.close();
    console.log(`${passed} passed, ${failed} failed`);
    process.exit(failed ? 1 : 0);
}

main().catch(failure => {
    console.error(failure);
    console.log(`${passed} passed, ${failed + 1} failed`);
    process.exit(1);
});
