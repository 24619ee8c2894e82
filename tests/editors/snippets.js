/* snippets.js -- node snippets.js FILE [NAME]: the names of the snippets for whole scenes, or the text of one
 * with what stands in its places at first. */
"use strict";
const snippets = JSON.parse(require("fs").readFileSync(process.argv[2], "utf8"));

if (process.argv[3] === undefined)
    /* a scene declares what it uses; a statement alone does not */
    for (const name of Object.keys(snippets).filter((name) => snippets[name].body.length > 3))
        console.log(name);
else
    console.log(snippets[process.argv[3]].body.join("\n").replace(/\$\{\d+:([^}]*)\}/g, "$1").replace(/\$\d/g, ""));
