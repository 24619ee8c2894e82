/* keep.js -- where scripts stay: in links, which hold a script compressed, and in the browser. A tab keeps its own script when it
 * is loaded again; a new one begins with the script that was changed last. */

const MOST = 1000000; /* letters of a script in a link */

const toLink = bytes => btoa(Array.from(bytes, b => String.fromCharCode(b)).join("")).replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
const fromLink = text => Uint8Array.from(atob(text.replace(/-/g, "+").replace(/_/g, "/")), c => c.charCodeAt(0));

/* What a stream makes of bytes, as bytes; it fails where that is more than `most`. */
async function through(stream, bytes, most) {
    const reader = new Blob([bytes]).stream().pipeThrough(stream).getReader(), parts = [];
    for (let all = 0;;) {
        const {done, value} = await reader.read();
        if (done)
            return new Uint8Array(await new Blob(parts).arrayBuffer());
        parts.push(value);
        all += value.length;
        if (all > most)
            throw new Error("too long");
    }
}

/* The part of an address that holds a script. */
export async function linkOf(script) {
    return "#script=" + toLink(await through(new CompressionStream("deflate-raw"), new TextEncoder().encode(script), Infinity));
}

/* The script that the address holds, or null; it fails where the address holds none that can be read. */
export async function scriptOfLink() {
    const coded = /^#script=(.*)/.exec(location.hash);
    if (!coded)
        return null;
    try {
        return new TextDecoder("utf-8", {fatal: true}).decode(await through(new DecompressionStream("deflate-raw"), fromLink(coded[1]), MOST));
    } catch {
        throw new Error("The link is damaged: no script can be read from it.");
    }
}

/* --- in the browser, which may keep nothing --------------------------------------------------------- */

function get(storage, key) {
    try {
        return globalThis[storage].getItem(key);
    } catch {
        return null;
    }
}

function set(storage, key, value) {
    try {
        globalThis[storage].setItem(key, value);
    } catch { /* the page works without */ }
}

/* "dark", "light", or null: as the system has it. */
export const keptTheme = () => get("localStorage", "qdot-theme");
export const keepTheme = theme => set("localStorage", "qdot-theme", theme);

/* The script to begin with where the address holds none, or null. */
export const keptScript = () => get("sessionStorage", "qdot-script") ?? get("localStorage", "qdot-script");

/* From now on keep what the editor holds. The address holds a script only as long as it is the editor's. */
export function keepScript(editor) {
    let timer = 0, changed = false;
    const keep = () => {
        clearTimeout(timer);
        if (!changed)
            return;
        changed = false;
        for (const storage of ["sessionStorage", "localStorage"])
            set(storage, "qdot-script", editor.getValue());
    };
    editor.on("change", () => {
        changed = true;
        clearTimeout(timer);
        timer = setTimeout(async () => {
            keep();
            const linked = await scriptOfLink().catch(() => "");
            if (linked !== null && linked !== editor.getValue())
                history.replaceState(null, "", location.pathname + location.search);
        }, 300);
    });
    addEventListener("pagehide", keep);
}
