/* test-page.js -- what a person does with the page: types, runs, asks, stops, opens, shares, loads again, on a telephone, by keyboard.
 * Each step states what is expected; `expect(good, what)` counts. */
"use strict";

const {ready} = require("./test-tools.js");

const SPRING = "param m, k > 0\ncoord x\nparticle p mass m at (x, 0)\npotential k*x^4/4\nset m = 1, k = 1\nstart x = 1\n";
const LONG = "run 0..1e7\n"; /* longer than anyone waits */

/* The page's ways, for one tab. */
function handsOf(page) {
    const idle = () => page.waitForFunction(() => !document.documentElement.dataset.running, null, {timeout: 120000});
    const hands = {
        idle,
        script: text => page.evaluate(t => qdotPage.editor.setValue(t), text),
        written: () => page.evaluate(() => qdotPage.editor.getValue()),
        answers: () => page.textContent("#answers"),
        status: () => page.textContent("#status"),
        focused: () => page.evaluate(() => document.activeElement.id || document.activeElement.className),
        async run(text) {
            if (text !== undefined)
                await hands.script(text);
            await page.click("#run");
            await idle();
        },
        async ask(text) {
            await page.fill("#line", text);
            await page.press("#line", "Enter");
            await page.waitForFunction(() => document.getElementById("line").value === "", null, {timeout: 120000});
            await idle();
        },
        async begin(text) { /* a run that does not end by itself */
            await hands.script(text);
            await page.click("#run");
            await page.waitForFunction(() => document.getElementById("answers").innerText.includes("computing"), null, {timeout: 120000});
        },
        inView: selector => page.evaluate(s => {
            const boxes = document.querySelectorAll(s), box = boxes[boxes.length - 1], pane = document.getElementById("answers").getBoundingClientRect();
            const at = box && box.getBoundingClientRect();
            return Boolean(box) && at.top < pane.bottom && at.bottom > pane.top && at.top < innerHeight && at.bottom > 0;
        }, selector),
        count: (text, part) => text.split(part).length - 1,
    };
    return hands;
}

const groups = {
    async "statements and answers"(page, expect, {run, ask, answers, status, inView, count, script}) {
        await script("coord x\nparticle p mass 1 at (x, 0)\n");
        await ask("T");
        expect((await answers()).includes("T"), "a line that is asked before the script was run goes on where the script ends");
        expect(!(await answers()).includes("unknown name"), "a line that is asked first knows the script's names");
        await run("param a\n" + "print 1\n".repeat(60) + "prnt 2\n");
        expect(await inView(".error"), "the error of a script is in view");
        expect((await answers()).includes("62"), "the error has its line");
        expect(count(await answers(), "prnt 2") === 1, "the wrong line is shown once");
        expect(await page.locator(".CodeMirror-linebackground.wrong").count() === 1, "the wrong line is marked");
        await ask("prnt 3");
        expect(await inView(".answer:last-child .error"), "the answer to a line is in view");
        expect(!/line 1\b|:1:/.test(await page.innerText(".answer:last-child")), "a line that was asked has no line number");
        await ask("check 1 == 1");
        expect(count(await page.innerText(".answer:last-child"), "1 == 1") === 1, "a claim is shown once");
        await script("# other\n");
        await ask("print 4");
        expect((await status()).includes("was changed"), "the status tells that the script is not the one that was run");
        await run("eom[q\n");
        expect((await answers()).includes("never closed"), "an open bracket is an error");
    },

    async "stopping"(page, expect, {begin, ask, answers, status, idle, run, focused}) {
        await begin(SPRING + "run 0..1\n" + LONG);
        await page.keyboard.press("Escape");
        await idle();
        expect((await answers()).includes("stopped"), "Esc stops, wherever the focus is");
        expect((await status()).includes("kept"), "the status tells that what was done is kept");
        expect(await focused() === "run", "the focus is again where it was");
        await ask("T");
        expect(!(await answers()).includes("nothing that moves"), "what a stopped script declared is kept");
        await ask("value(x, 0)");
        expect(/value\(x, 0\)=1\b/.test(await answers()), "a run before the stop is made again");
        await page.fill("#line", LONG.trim());
        await page.press("#line", "Enter");
        await page.waitForFunction(() => document.getElementById("answers").innerText.includes("computing"), null, {timeout: 60000});
        await page.click("#stop");
        await idle();
        await page.fill("#line", LONG.trim());
        await page.press("#line", "Enter");
        await page.waitForTimeout(30); /* while the session is made again */
        await page.keyboard.press("Escape");
        await idle();
        await ask("V");
        expect((await answers()).includes("V=") && !(await answers()).includes("error:"), "nothing is lost when two computations are stopped");
        await begin(SPRING + LONG);
        await page.selectOption("#examples", {index: 1});
        await page.waitForFunction(() => !document.getElementById("status").textContent.includes("stopped"), null, {timeout: 60000});
        await idle();
        expect((await status()).startsWith("done"), "an example that is chosen during a computation is run");
    },

    async "keyboard, completion, help"(page, expect, {script, written, focused}) {
        const hinted = () => page.evaluate(() => [...document.querySelectorAll(".CodeMirror-hint")].map(e => e.textContent));
        await script("coord theta\n");
        await page.click(".CodeMirror");
        await page.keyboard.press("Control+End");
        await page.keyboard.type("pl");
        await page.keyboard.press("Tab");
        await page.waitForSelector(".CodeMirror-hint");
        expect((await hinted()).includes("plot"), "Tab completes a word");
        await page.keyboard.press("Escape");
        await page.keyboard.type("ot th");
        await page.keyboard.press("Control+Space");
        await page.waitForFunction(() => qdotPage.editor.getValue().endsWith("plot theta"), null, {timeout: 10000}).then(
            () => expect(true, ""), () => expect(false, "a declared name is completed"));
        await page.keyboard.press("Home");
        await page.keyboard.press("F1");
        await page.waitForSelector(".help");
        expect((await page.innerText(".help")).includes("plot"), "F1 explains a word");
        await page.keyboard.press("Escape");
        expect(await page.locator(".help").count() === 0, "Esc closes the help");
        await page.keyboard.press("Tab");
        expect(!/CodeMirror/.test(await focused()), "Esc and Tab leave the editor");
        expect(await written() === "coord theta\nplot theta", "leaving the editor does not change the script");
        const order = [];
        for (let i = 0; i < 24 && !order.includes("theme"); i++) {
            await page.keyboard.press("Tab");
            order.push(await focused());
        }
        for (const name of ["examples", "share", "save", "choose", "theme"])
            expect(order.includes(name), `Tab reaches ${name}`);
        await page.selectOption("#examples", {index: 1});
        await page.waitForFunction(() => qdotPage.editor.getValue().length > 50);
        await page.waitForFunction(() => !document.documentElement.dataset.running, null, {timeout: 60000});
        await page.click(".CodeMirror");
        await page.keyboard.press("Control+z");
        expect(await written() === "coord theta\nplot theta", "the script that an example replaced comes back");
    },

    async "files"(page, expect, {run, answers, written, status}) {
        const give = (...all) => page.setInputFiles("#open", all.map(([name, text]) => ({name, mimeType: "text/plain", buffer: Buffer.from(text)})));
        await give(["d.txt", "t,x\n0,1\n1,2\n2,3\n3,4\n"], ["mine.lag", "coord y\nprint 12\n"]);
        await page.waitForFunction(() => qdotPage.editor.getValue().includes("print 12"));
        expect((await status()).includes("d.txt"), "data that stand beside a script can be read");
        const download = page.waitForEvent("download");
        await page.click(".CodeMirror");
        await page.keyboard.press("Control+s");
        expect((await download).suggestedFilename() === "mine.lag", "Ctrl-S saves under the name of the file that was opened");
        await run("coord x\nlagrangian x'^2/2\nstart x = 0, x' = 2\nfit x, x' to \"d.txt\" : t, x sigma 0.1\nrun 0..3\ntable x every 1 to \"o.csv\"\n");
        expect(!(await answers()).includes("error:") && /x=1/.test(await answers()), "a fit reads the file");
        const table = page.waitForEvent("download");
        await page.click("[data-file]");
        expect((await table).suggestedFilename() === "o.csv", "a file that a statement wrote can be downloaded");
        await run("coord x\nlagrangian x'^2/2\nstart x = 1\nrun 0..1\nplot x to \"a.png\"\n");
        expect((await answers()).includes(".svg"), "a picture that cannot be made here says which can");
    },

    async "links and reload"(page, expect, {script, written, answers}, context, address) {
        await page.goto(address);
        await ready(page);
        await script("coord mine\n");
        await page.waitForTimeout(500);
        await page.click("#share");
        await page.waitForFunction(() => location.hash.length > 10);
        const link = page.url(), other = await context.newPage();
        await other.goto(link);
        await other.waitForFunction(() => qdotPage.editor.getValue() === "coord mine\n", null, {timeout: 20000}).then(
            () => expect(true, ""), () => expect(false, "a link brings its script"));
        expect(await other.evaluate(() => document.querySelectorAll("#answers .answer").length) === 0, "a link does not run by itself");
        await other.evaluate(() => qdotPage.editor.replaceRange("# edited\n", {line: 1, ch: 0}));
        await other.waitForFunction(() => location.hash === "", null, {timeout: 5000}).then(
            () => expect(true, ""), () => expect(false, "the address holds the script only as long as it is the editor's"));
        await other.reload();
        await ready(other);
        expect((await handsOf(other).written()).includes("# edited"), "a script that was changed is there after loading again");
        await page.goto("about:blank");
        await page.goto(address);
        await ready(page);
        expect(await written() === "coord mine\n", "each tab keeps its own script");
        for (const wrong of ["#script=", "#script=%%%", "#script=abc", "#script=" + "A".repeat(5000), link.slice(link.indexOf("#"), -3)]) {
            await other.goto("about:blank");
            await other.goto(address + wrong);
            await ready(other);
            expect((await handsOf(other).answers()).includes("damaged"), `a wrong link is named: ${wrong.slice(0, 20)}`);
            expect((await handsOf(other).written()).includes("# edited"), "a wrong link leaves the script as it was");
        }
        const bomb = await other.evaluate(async () => {
            const packed = await new Response(new Blob(["x".repeat(3e7)]).stream().pipeThrough(new CompressionStream("deflate-raw"))).arrayBuffer();
            return "#script=" + btoa(Array.from(new Uint8Array(packed), b => String.fromCharCode(b)).join("")).replace(/\+/g, "-").replace(/\//g, "_");
        });
        await other.goto("about:blank");
        await other.goto(address + bomb);
        await ready(other);
        expect((await handsOf(other).written()).length < 1e6, "a link that grows without bound is not unpacked");
        await other.close();
        expect(!(await answers()).includes("damaged"), "a page without link names none");
    },

    async "texts stay texts"(page, expect, {run, ask}) {
        const evil = n => `<img src=x onerror=globalThis.broken=${n}>`;
        await run(`param a\ncoord x\nparticle p mass 1 at (x, 0)\nprint "${evil(1)}<script>globalThis.broken=2</script>"\nstart x = 1\nrun 0..1\n` +
                  `plot x title "${evil(3)}</text></svg>${evil(4)}" xlabel "</svg>${evil(5)}"\ntable x every 0.5 to "${evil(6)}.csv"\n` +
                  `table x every 0.5 to "javascript:alert(1).csv"\nfit a to "${evil(7)}" : t, x\n`);
        for (const line of [evil(8), `print "${evil(9)}"`, `help search ${evil(10)}`, `show ${evil(11)}`, `check 1 == 2 when "${evil(12)}"`])
            await ask(line);
        await page.waitForTimeout(200);
        expect(await page.evaluate(() => globalThis.broken) === undefined, "no text of a script becomes a part of the page");
        expect(await page.locator("#answers img, #answers script, #answers a[href^=javascript]").count() === 0, "no element comes from a text");
    },

    async "numbers of time"(page, expect) {
        const all = await page.evaluate(async () => {
            const found = [];
            await qdotPage.call({kind: "ask", line: 1, fresh: true, text: "coord x\nparticle p mass 1 at (x, 0)\npotential x^4\nstart x = 1\nrace 0..1\n"},
                data => found.push(...(data.answers || [])));
            return found;
        });
        const columns = all.find(a => a.kind === "columns"), at = columns ? columns.columns.indexOf("cpu") : -1;
        const times = all.filter(a => a.kind === "row").map(a => a.values[at]).filter(t => t !== null);
        expect(at >= 0 && times.length > 3 && times.every(t => t >= 0 && t < 60), `times of a race are times: ${times}`);
    },

    async "narrow windows"(page, expect, {run}) {
        await page.setViewportSize({width: 360, height: 640});
        await run("param m1, m2, l1, l2, g > 0\ncoord theta1, theta2\nparticle a mass m1 at (l1*sin(theta1), -l1*cos(theta1))\n" +
                  "particle b mass m2 at a + (l2*sin(theta2), -l2*cos(theta2))\ngravity (0, -g)\neom\nset m1 = 1, m2 = 1, l1 = 1, l2 = 1, g = 9.81\n" +
                  "start theta1 = 1\nrun 0..1\nplot theta1\nanimate\n");
        const size = await page.evaluate(() => ({wide: document.documentElement.scrollWidth, bar: document.querySelector("header").offsetHeight,
            line: document.getElementById("ask").getBoundingClientRect().bottom, status: document.querySelector("footer").getBoundingClientRect().bottom,
            formula: Math.max(...[...document.querySelectorAll("#answers math")].map(m => m.getBoundingClientRect().right))}));
        expect(size.wide <= 360, `nothing is wider than a narrow window: ${size.wide}`);
        expect(size.bar <= 90, `the buttons take two rows: ${size.bar}`);
        expect(size.line <= 640 && size.status <= 640, "the line and the status stay in a narrow window");
        expect(size.formula <= 360, `long equations are broken into lines: ${size.formula}`);
        expect(await page.evaluate(() => document.querySelector(".answer").getBoundingClientRect().top < innerHeight - 100), "the answers come into view");
        await page.setViewportSize({width: 1280, height: 800});
        await page.evaluate(() => document.querySelector("iframe").scrollIntoView());
        await page.waitForFunction(() => parseInt(document.querySelector("iframe").style.height) > 400, null, {timeout: 60000}).then(
            () => expect(true, ""), () => expect(false, "a frame is as high as its page"));
    },

    async "dark"(page, expect, {run}) {
        await page.click("#theme");
        await run("coord x\nparticle p mass 1 at (x, 0)\nstart x = 1\nrun 0..1\nplot x\n");
        const light = c => /rgb\((\d+), (\d+), (\d+)\)/.exec(c).slice(1).reduce((s, x) => s + Number(x), 0) / 3;
        const colours = await page.evaluate(() => ["body", ".figure a", ".asked", "h1"].map(s => getComputedStyle(document.querySelector(s)).color));
        expect(colours.every(c => light(c) > 110), `all words can be read in the dark: ${colours}`);
        await page.reload();
        await ready(page);
        expect(await page.evaluate(() => document.documentElement.classList.contains("dark")), "the look is kept");
        await page.click("#theme");
    },
};

/* Carry out every group in one tab. */
module.exports = async (context, address, expect) => {
    const page = await context.newPage();
    page.on("pageerror", e => expect(false, "the page: " + e.message));
    page.on("dialog", dialog => {
        expect(false, "a dialog: " + dialog.message());
        dialog.dismiss();
    });
    await page.goto(address);
    await ready(page);
    for (const [name, steps] of Object.entries(groups)) {
        const begun = Date.now();
        await steps(page, (good, what) => expect(good, `${name}: ${what}`), handsOf(page), context, address)
            .catch(failure => expect(false, `${name}: ${failure.message.split("\n")[0]}`));
        await page.setViewportSize({width: 1280, height: 800});
        console.log(`${name}: ${Date.now() - begun} ms`);
    }
    await page.close();
};
