/* service.js -- keeps the page's files, so that it works without network: from the cache at once, renewed behind. */
"use strict";

const KEEP = "qdot-@version@";
const files = ["./", "index.html", "page.css", "bundle.js", "module.js", "examples.js", "icon.svg", "math.woff2"];

self.addEventListener("install", event => event.waitUntil(
    caches.open(KEEP).then(cache => cache.addAll(files)).then(() => self.skipWaiting())));
self.addEventListener("activate", event => event.waitUntil(
    caches.keys().then(keys => Promise.all(keys.filter(k => k.startsWith("qdot-") && k !== KEEP).map(k => caches.delete(k))))
        .then(() => self.clients.claim())));
self.addEventListener("fetch", event => {
    if (event.request.method === "GET" && new URL(event.request.url).origin === location.origin)
        event.respondWith(caches.match(event.request, {ignoreSearch: true}).then(kept => kept || fetch(event.request)));
});
