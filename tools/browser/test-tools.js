/* test-tools.js -- what the parts of the test share. */
"use strict";

/* The page can compute. */
exports.ready = page => page.waitForFunction(() => document.documentElement.dataset.ready, null, {timeout: 60000});
