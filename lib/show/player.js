/* player.js -- the runs that qdot wrote into this page, moving: each section.animation holds its
 * data as JSON (lib/show/animation.h) and gets a drawing, two diagrams and the controls. */
"use strict";
(function () {

/* --- numbers ------------------------------------------------------------------------- */

/* A channel: a number, or {a, b, d}: a + b u of 16-bit numbers u in base64. */
function decode(channel) {
  if (typeof channel === "number")
    return { lo: channel, hi: channel, still: true, at: null };
  const bytes = atob(channel.d), n = bytes.length >> 1, at = new Float64Array(n);
  let lo = Infinity, hi = -Infinity;
  for (let k = 0; k < n; k++) {
    const u = bytes.charCodeAt(2 * k) | bytes.charCodeAt(2 * k + 1) << 8;
    at[k] = u === 65535 ? NaN : channel.a + channel.b * u;
    if (at[k] < lo) lo = at[k];
    if (at[k] > hi) hi = at[k];
  }
  return { lo, hi, still: false, at };
}

/* At frame s, not always whole: a cubic that does not overshoot. */
function read(c, s) {
  if (c.still) return c.lo;
  const a = c.at, last = a.length - 1, k = Math.max(0, Math.min(last - 1, Math.floor(s))), u = s - k;
  if (u === 0 || last === 0) return a[k];
  const y0 = a[k], y1 = a[k + 1], d = y1 - y0;
  const before = k > 0 ? y0 - a[k - 1] : d, after = k + 2 <= last ? a[k + 2] - y1 : d;
  const m0 = before * d > 0 ? (before + d) / 2 : 0, m1 = after * d > 0 ? (after + d) / 2 : 0;
  const value = y0 + u * (m0 + u * (3 * d - 2 * m0 - m1 + u * (m0 + m1 - 2 * d)));
  return isFinite(value) ? value : u < 0.5 ? y0 : y1;
}

/* 1, 2 or 5 times a power of ten: at most `most` steps in the span. */
function niceStep(span, most) {
  if (!(span > 0)) return 1;
  const ten = Math.pow(10, Math.floor(Math.log10(span / most)));
  for (const f of [1, 2, 5, 10]) if (span / (f * ten) <= most) return f * ten;
  return 10 * ten;
}

function short(x, step) {
  if (Math.abs(x) < step * 1e-6) return "0";
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const text = digits > 5 || Math.abs(x) >= 1e6 ? x.toExponential(1) : x.toFixed(digits);
  return text.replace("-", "\u2212");
}

function make(kind, parent, name, text) {
  const e = document.createElement(kind);
  if (name) e.className = name;
  if (text !== undefined) e.textContent = text;
  if (parent) parent.appendChild(e);
  return e;
}

/* A canvas that fills its holder, in the pixels of the screen. */
function surface(parent) {
  const hold = make("div", parent, "hold"), canvas = make("canvas", hold);
  return {
    hold, canvas, w: 0, h: 0,
    begin() {
      const box = canvas.getBoundingClientRect();
      const ratio = Math.max(window.matchMedia("print").matches ? 3 : 1, window.devicePixelRatio || 1);
      const w = Math.max(1, Math.round(box.width * ratio)), h = Math.max(1, Math.round(box.height * ratio));
      if (canvas.width !== w || canvas.height !== h) { canvas.width = w; canvas.height = h; }
      this.w = w / ratio; this.h = h / ratio;
      const g = canvas.getContext("2d");
      g.setTransform(ratio, 0, 0, ratio, 0, 0);
      g.clearRect(0, 0, this.w, this.h);
      g.lineJoin = g.lineCap = "round";
      return g;
    }
  };
}

/* --- a run --------------------------------------------------------------------------- */

function Animation(section) {
  const data = JSON.parse(section.querySelector("script").textContent);
  const channels = data.channels.map(decode), frames = data.frames;
  const space = data.dimension === 3;
  const colours = {};
  let frame = 0, playing = false, speed = data.speed, trail = data.trail, loop = true;
  let stamp = 0, stateShown = 0, yaw = -0.6, pitch = 0.32;

  const seconds = Math.abs(data.t1 - data.t0);        /* of the run's time */
  const perSecond = (frames - 1) / (seconds || 1);    /* frames in a unit of it */
  const timeAt = s => data.t0 + (data.t1 - data.t0) * s / Math.max(1, frames - 1);

  const where = (p, s) => data.points[p].map(c => read(channels[c], s));
  const isStill = p => data.points[p].every(c => channels[c].still);

  function readColours() {
    const style = getComputedStyle(section);
    for (const name of ["ink", "faint", "line", "grid", "paper", "well", "rod", "body",
                        "c0", "c1", "c2", "c3", "c4", "c5", "c6", "c7"])
      colours[name] = style.getPropertyValue("--" + name).trim() || "#000";
  }
  const colourOf = i => colours["c" + i % 8];

  /* --- extent ------------------------------------------------------------------------ */

  const reach = b => b.shape === "disc" ? b.half[0] : Math.hypot(...b.half);
  const box = { lo: [Infinity, Infinity, Infinity], hi: [-Infinity, -Infinity, -Infinity] };
  function include(p, more) {
    data.points[p].forEach((c, d) => {
      box.lo[d] = Math.min(box.lo[d], channels[c].lo - more);
      box.hi[d] = Math.max(box.hi[d], channels[c].hi + more);
    });
  }
  data.points.forEach((_, p) => include(p, 0));
  data.bodies.forEach(b => include(b.point, reach(b)));
  const dims = space ? 3 : 2, centre = [0, 1, 2].map(d => d < dims ? (box.lo[d] + box.hi[d]) / 2 : 0);
  let radius = 0, lowest = 0; /* along `up`, from the centre */
  for (let k = 0; k < frames; k += Math.max(1, Math.floor(frames / 1500)))
    data.points.forEach((_, p) => {
      const r = where(p, k), own = data.bodies.find(b => b.point === p);
      radius = Math.max(radius, Math.hypot(...r.map((x, d) => x - centre[d])) + (own ? reach(own) : 0));
      const below = own && space
        ? Math.hypot(...axesOf(own, k).map((e, i) => own.half[i] * e.reduce((sum, x, d) => sum + x * data.up[d], 0)))
        : 0;
      lowest = Math.min(lowest, r.reduce((sum, x, d) => sum + (x - centre[d]) * data.up[d], -below));
    });
  if (!(radius > 0)) radius = 1;
  const width = Math.max(box.hi[0] - box.lo[0], radius / 5), height = Math.max(box.hi[1] - box.lo[1], radius / 5);
  const lengths = data.links.map(link => {
    let lo = Infinity, hi = 0;
    for (let k = 0; k < frames; k += Math.max(1, Math.floor(frames / 1000))) {
      const a = where(link.from, k), b = where(link.to, k);
      const d = Math.hypot(...a.map((x, i) => x - b[i]));
      lo = Math.min(lo, d); hi = Math.max(hi, d);
    }
    return { lo, hi };
  });

  /* --- the controls ------------------------------------------------------------------ */

  if (data.title) make("h2", section, "", data.title);
  const stage = make("div", section, "stage"), scene = surface(stage), side = make("div", stage, "side");
  scene.hold.style.minHeight = "300px";
  scene.hold.style.aspectRatio = space ? "1.15" : String(Math.min(2, Math.max(0.85, width / height)));
  scene.canvas.setAttribute("role", "img");
  scene.canvas.setAttribute("aria-label", "animation: " + (data.title || "a run"));

  const phaseFigure = make("figure", side), phaseCaption = make("figcaption", phaseFigure, "", "phase portrait");
  const phase = surface(phaseFigure);
  if (data.states.length > 1) {
    const pick = make("select", phaseCaption);
    pick.setAttribute("aria-label", "coordinate of the phase portrait");
    data.states.forEach((s, i) => { make("option", pick, "", s.name).value = i; });
    pick.onchange = () => { stateShown = +pick.value; draw(); };
  }
  if (data.states.length === 0) phaseFigure.style.display = "none";
  const energyFigure = make("figure", side);
  make("figcaption", energyFigure, "", "energies against t");
  const energy = surface(energyFigure);
  if (data.energies.length === 0) energyFigure.style.display = "none";

  const bar = make("div", section, "bar");
  const playButton = make("button", bar, "play"), slider = make("input", bar, "time");
  slider.type = "range"; slider.min = 0; slider.max = frames - 1; slider.step = "any"; slider.value = 0;
  slider.setAttribute("aria-label", "time");
  const clock = make("output", bar);
  const speedLabel = make("label", bar, "", "speed"), speedPick = make("select", speedLabel);
  const speeds = [...new Set([0.1, 0.25, 0.5, 1, 2, 4, 10].map(f => f * data.speed).concat([1]))]
    .sort((a, b) => a - b);
  speeds.forEach(v => {
    const option = make("option", speedPick, "", "\u00d7" + +v.toPrecision(3));
    option.value = v; option.selected = v === data.speed;
  });
  speedPick.onchange = () => { speed = +speedPick.value; };
  const loopLabel = make("label", bar), loopBox = make("input", loopLabel);
  loopBox.type = "checkbox"; loopBox.checked = true; loopLabel.append("loop");
  loopBox.onchange = () => { loop = loopBox.checked; };
  const trailLabel = make("label", bar, "", "trail"), trailPick = make("input", trailLabel, "trail");
  trailPick.type = "range"; trailPick.min = 0; trailPick.max = 1; trailPick.step = 0.01;
  trailPick.value = seconds > 0 ? Math.sqrt(Math.min(1, trail / seconds)) : 0;
  trailPick.oninput = () => { trail = seconds * trailPick.value * trailPick.value; draw(); };
  playButton.onclick = () => play(!playing);
  slider.oninput = () => { frame = +slider.value; draw(); };
  section.tabIndex = 0;
  section.onkeydown = e => {
    if (e.target !== section && e.target.tagName !== "CANVAS") return;
    if (e.key === " ") play(!playing);
    else if (e.key === "ArrowRight" || e.key === "ArrowLeft")
      seek(frame + (e.key === "ArrowRight" ? 1 : -1) * perSecond * speed / 10);
    else if (e.key === "Home") seek(0);
    else return;
    e.preventDefault();
  };

  const facts = make("dl", section);
  data.facts.forEach(([name, text]) => { make("dt", facts, "", name); make("dd", facts, "", text); });

  function play(on) {
    playing = on;
    if (on && frame >= frames - 1) frame = 0;
    playButton.textContent = on ? "pause" : "play";
    if (on) { stamp = 0; requestAnimationFrame(tick); }
  }
  function seek(s) { frame = Math.max(0, Math.min(frames - 1, s)); slider.value = frame; draw(); }
  function tick(now) {
    if (!playing) return;
    if (stamp > 0) {
      frame += Math.min(0.25, (now - stamp) / 1000) * speed * perSecond;
      if (frame >= frames - 1) {
        frame = loop ? 0 : frames - 1;
        if (!loop) play(false);
      }
      seek(frame);
    }
    stamp = now;
    if (playing) requestAnimationFrame(tick);
  }

  /* --- from the scene to the canvas -------------------------------------------------- */

  let look; /* {right, up, out: unit vectors of the screen, scale, x, y} */
  function aim() {
    const edge = space ? 26 : 34;
    look = { x: scene.w / 2, y: scene.h / 2 };
    if (!space) {
      look.x += 8; look.y -= 6;
      look.scale = Math.min((scene.w - 2 * edge) / width, (scene.h - 2 * edge) / height);
      return;
    }
    const u = data.up, k = [0, 1, 2].reduce((m, d) => Math.abs(u[d]) < Math.abs(u[m]) - 1e-9 ? d : m, 0);
    const first = [0, 0, 0]; first[k] = 1;
    const along = first[0] * u[0] + first[1] * u[1] + first[2] * u[2];
    let e1 = first.map((x, d) => x - along * u[d]);
    const size = Math.hypot(...e1); e1 = e1.map(x => x / size);
    const e2 = cross(u, e1), c = Math.cos(yaw), s = Math.sin(yaw), cp = Math.cos(pitch), sp = Math.sin(pitch);
    const flat = [0, 1, 2].map(d => s * e1[d] - c * e2[d]); /* towards the eye, level */
    look.right = [0, 1, 2].map(d => c * e1[d] + s * e2[d]);
    look.up = [0, 1, 2].map(d => cp * u[d] - sp * flat[d]);
    look.out = [0, 1, 2].map(d => cp * flat[d] + sp * u[d]);
    look.ground = [e1, e2];
    look.scale = (Math.min(scene.w, scene.h) / 2 - edge) / radius;
  }
  function cross(a, b) {
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  }
  const dot = (a, b) => a.reduce((sum, x, d) => sum + x * b[d], 0);
  /* [x, y on the canvas, nearness to the eye, scale there] */
  function project(r) {
    if (!space)
      return [look.x + (r[0] - centre[0]) * look.scale, look.y - (r[1] - centre[1]) * look.scale, 0, look.scale];
    const d = r.map((x, i) => x - centre[i]), near = dot(d, look.out);
    const f = look.scale * 5 * radius / (5 * radius - near); /* a mild perspective */
    return [look.x + dot(d, look.right) * f, look.y - dot(d, look.up) * f, near, f];
  }

  function line(g, points) {
    g.beginPath();
    points.forEach((p, i) => { if (i === 0) g.moveTo(p[0], p[1]); else g.lineTo(p[0], p[1]); });
  }

  /* --- what is drawn ----------------------------------------------------------------- */

  function drawGrid(g) {
    g.lineWidth = 1; g.strokeStyle = colours.grid; g.fillStyle = colours.faint;
    g.font = "11px system-ui,sans-serif";
    if (space) return drawGround(g);
    const step = niceStep(Math.max(scene.w, scene.h) / look.scale, 12);
    const left = centre[0] - look.x / look.scale, top = centre[1] + look.y / look.scale;
    g.textAlign = "center"; g.textBaseline = "alphabetic";
    for (let x = Math.ceil(left / step) * step; ; x += step) {
      const at = project([x, 0])[0];
      if (at > scene.w) break;
      g.strokeStyle = Math.abs(x) < step / 2 ? colours.line : colours.grid;
      line(g, [[at, 0], [at, scene.h]]); g.stroke();
      if (at > 40 && at < scene.w - 20) g.fillText(short(x, step), at, scene.h - 5);
    }
    g.textAlign = "left"; g.textBaseline = "middle";
    for (let y = Math.floor(top / step) * step; ; y -= step) {
      const at = project([0, y])[1];
      if (at > scene.h) break;
      g.strokeStyle = Math.abs(y) < step / 2 ? colours.line : colours.grid;
      line(g, [[0, at], [scene.w, at]]); g.stroke();
      if (at < scene.h - 22 && at > 12) g.fillText(short(y, step), 5, at);
    }
  }
  function drawGround(g) {
    const step = niceStep(2 * radius, 8), n = Math.ceil(radius / step), [e1, e2] = look.ground;
    const low = lowest, at = (i, j) =>
      project([0, 1, 2].map(d => centre[d] + low * data.up[d] + step * (i * e1[d] + j * e2[d])));
    for (let i = -n; i <= n; i++) {
      line(g, [at(i, -n), at(i, n)]); g.stroke();
      line(g, [at(-n, i), at(n, i)]); g.stroke();
    }
    g.textAlign = "right"; g.textBaseline = "alphabetic";
    g.fillText("grid " + short(step, step) + "; drag to turn", scene.w - 8, scene.h - 8);
    const corner = [34, scene.h - 34];
    g.strokeStyle = colours.faint; g.textAlign = "center"; g.textBaseline = "middle";
    ["x", "y", "z"].forEach((name, d) => {
      const x = look.right[d] * 20, y = -look.up[d] * 20;
      line(g, [corner, [corner[0] + x, corner[1] + y]]); g.stroke();
      g.fillText(name, corner[0] + x * 1.45, corner[1] + y * 1.45);
    });
  }

  function drawTrail(g, p, colour) {
    const from = Math.max(0, frame - trail * perSecond), bands = 16;
    if (!(trail > 0) || isStill(p)) return;
    g.strokeStyle = colour; g.lineWidth = 1.6;
    for (let b = 0; b < bands; b++) {
      const s0 = from + (frame - from) * b / bands, s1 = from + (frame - from) * (b + 1) / bands;
      const points = [], step = Math.max(1, (s1 - s0) / 400);
      for (let s = s0; s < s1; s += step) points.push(project(where(p, s)));
      points.push(project(where(p, s1)));
      g.globalAlpha = 0.08 + 0.62 * (b + 1) / bands;
      line(g, points); g.stroke();
    }
    g.globalAlpha = 1;
  }

  /* Along from a to b, sideways to it: a point of a spring or dashpot. */
  function frameOf(a, b) {
    const dx = b[0] - a[0], dy = b[1] - a[1], length = Math.hypot(dx, dy) || 1e-9;
    return { length, at: (x, y) => [a[0] + (dx * x - dy * y) / length, a[1] + (dy * x + dx * y) / length] };
  }
  function drawSpring(g, a, b, aside, size) {
    const f = frameOf(a, b), lead = Math.min(12, f.length * 0.14), turns = 11, points = [];
    const pitch = (f.length - 2 * lead) / turns;
    points.push(f.at(0, 0));
    if (aside) points.push(f.at(0, aside));
    points.push(f.at(lead, aside));
    for (let k = 0; k <= turns * 16; k++) {
      const phi = 2 * Math.PI * k / 16, part = k / (turns * 16);
      const fade = Math.min(1, part * 12, (1 - part) * 12);
      points.push(f.at(lead + (f.length - 2 * lead) * part + fade * pitch * 0.3 * (Math.cos(phi) - 1),
                       aside + fade * size * Math.sin(phi)));
    }
    points.push(f.at(f.length - lead, aside));
    if (aside) points.push(f.at(f.length, aside));
    points.push(f.at(f.length, 0));
    g.lineWidth = 1.5; line(g, points); g.stroke();
  }
  function drawDamper(g, a, b, aside, size, stroke) {
    const f = frameOf(a, b), from = f.length * 0.26, to = f.length * 0.74;
    const at = from + (to - from) * (0.15 + 0.7 * stroke);
    g.lineWidth = 1.6;
    line(g, [f.at(0, 0), f.at(0, aside), f.at(from, aside)]); g.stroke();
    line(g, [f.at(to, aside + size), f.at(from, aside + size), f.at(from, aside - size),
             f.at(to, aside - size)]); g.stroke();
    line(g, [f.at(at, aside), f.at(f.length, aside), f.at(f.length, 0)]); g.stroke();
    g.lineWidth = 3;
    line(g, [f.at(at, aside + size * 0.75), f.at(at, aside - size * 0.75)]); g.stroke();
  }
  const lanes = data.links.map(link => {
    const same = data.links.filter(l => l.kind !== "rod" &&
      (l.from === link.from && l.to === link.to || l.from === link.to && l.to === link.from));
    return link.kind === "rod" || same.length < 2 ? 0
      : (same.indexOf(link) - (same.length - 1) / 2) * (link.from > link.to ? -1 : 1);
  });
  function drawLink(g, i) {
    const link = data.links[i], a = project(where(link.from, frame)), b = project(where(link.to, frame));
    const size = Math.max(4, Math.min(9, Math.min(scene.w, scene.h) * 0.016));
    const aside = lanes[i] * size * 3.2;
    if (link.kind === "rod") {
      g.strokeStyle = colours.rod; g.lineWidth = 3; line(g, [a, b]); g.stroke();
    } else if (link.kind === "spring") {
      g.strokeStyle = colours.c2; drawSpring(g, a, b, aside, size);
    } else {
      const l = lengths[i], p = where(link.from, frame), q = where(link.to, frame);
      const now = Math.hypot(...p.map((x, d) => x - q[d]));
      g.strokeStyle = colours.c3;
      drawDamper(g, a, b, aside, size, l.hi > l.lo ? (now - l.lo) / (l.hi - l.lo) : 0.5);
    }
  }

  /* The columns of its rotation. */
  function axesOf(b, s) {
    const m = b.axes.map(c => read(channels[c], s));
    if (!space) return [[m[0], m[1]], [-m[1], m[0]]];
    const e1 = m.slice(0, 3), e2 = m.slice(3, 6), own = [e1, e2, cross(e1, e2)];
    return b.principal === undefined ? own
      : [0, 1, 2].map(k => [0, 1, 2].map(d => own.reduce((sum, e, j) => sum + e[d] * b.principal[3 * k + j], 0)));
  }
  function drawBody(g, b, i) {
    const r = where(b.point, frame), axes = axesOf(b, frame);
    g.strokeStyle = colours.rod; g.fillStyle = colours.body; g.lineWidth = 1.6;
    for (const p of b.arms || []) {
      g.lineWidth = 3; line(g, [project(where(p, frame)), project(r)]); g.stroke(); g.lineWidth = 1.6;
    }
    if (space) return drawEllipsoid(g, r, axes, b.half);
    const own = (x, y) => project(r.map((c, d) => c + x * axes[0][d] + y * axes[1][d]));
    if (b.shape === "disc") {
      const p = project(r);
      g.globalAlpha = 0.55; g.beginPath(); g.arc(p[0], p[1], Math.max(4, b.half[0] * look.scale), 0, 7); g.fill();
      g.globalAlpha = 1; g.stroke();
      line(g, [p, own(b.half[0], 0)]); g.stroke();
    } else {
      const [c, s] = b.turn, a = b.half[0], h = Math.max(b.half[1], 3.5 / look.scale);
      const corner = (x, y) => own(x * c - y * s, x * s + y * c);
      line(g, [corner(a, h), corner(-a, h), corner(-a, -h), corner(a, -h)]);
      g.closePath();
      g.globalAlpha = 0.55; g.fill(); g.globalAlpha = 1; g.stroke();
    }
    const p = project(r);
    g.fillStyle = colours.ink; g.beginPath(); g.arc(p[0], p[1], 2.2, 0, 7); g.fill();
  }
  /* Its outline, the circles in its principal planes (faint behind), its axes. */
  function drawEllipsoid(g, r, axes, half) {
    const p = project(r), thin = 2.5 / look.scale, size = half.map(h => Math.max(h, thin));
    let xx = 0, xy = 0, yy = 0;
    axes.forEach((e, k) => {
      const x = dot(e, look.right) * size[k], y = dot(e, look.up) * size[k];
      xx += x * x; xy += x * y; yy += y * y;
    });
    const mean = (xx + yy) / 2, off = Math.hypot((xx - yy) / 2, xy);
    const angle = 0.5 * Math.atan2(2 * xy, xx - yy);
    g.beginPath();
    g.ellipse(p[0], p[1], Math.sqrt(mean + off) * p[3], Math.sqrt(Math.max(0, mean - off)) * p[3],
              -angle, 0, 2 * Math.PI);
    g.globalAlpha = 0.45; g.fill(); g.globalAlpha = 1; g.stroke();
    g.lineWidth = 1;
    for (let k = 0; k < 3; k++) {
      const a = axes[(k + 1) % 3], b = axes[(k + 2) % 3], ha = size[(k + 1) % 3], hb = size[(k + 2) % 3];
      let before = null;
      for (let j = 0; j <= 48; j++) {
        const c = Math.cos(j * Math.PI / 24) * ha, s = Math.sin(j * Math.PI / 24) * hb;
        const way = [0, 1, 2].map(d => a[d] * c + b[d] * s), now = project(way.map((x, d) => r[d] + x));
        if (before) {
          g.globalAlpha = now[2] < p[2] ? 0.18 : 0.7;
          line(g, [before, now]); g.stroke();
        }
        before = now;
      }
    }
    g.globalAlpha = 1; g.lineWidth = 2.4;
    const longest = Math.max(...size);
    axes.forEach((e, k) => {
      g.strokeStyle = [colours.c1, colours.c2, colours.c0][k];
      const end = size[k] + 0.35 * longest;
      line(g, [project(r), project(r.map((x, d) => x + e[d] * end))]); g.stroke();
    });
  }

  function drawJoint(g, p) {
    const at = project(where(p, frame));
    g.lineWidth = 1.4; g.strokeStyle = colours.rod; g.fillStyle = colours.well;
    if (isStill(p) && !space)
      for (let k = -1; k <= 2; k++) {
        line(g, [[at[0] + 5 * k, at[1] + 7], [at[0] + 5 * k - 5, at[1] + 12]]); g.stroke();
      }
    if (isStill(p) && !space) { line(g, [[at[0] - 9, at[1] + 7], [at[0] + 11, at[1] + 7]]); g.stroke(); }
    g.beginPath(); g.arc(at[0], at[1], 4, 0, 7); g.fill(); g.stroke();
  }
  function drawParticle(g, particle, i) {
    const at = project(where(particle.point, frame));
    const few = Math.min(1, Math.sqrt(8 / data.particles.length));
    const size = Math.max(2.5, Math.min(scene.w, scene.h) * 0.02 * particle.size * few);
    g.fillStyle = colourOf(i); g.strokeStyle = colours.paper; g.lineWidth = 1.5;
    g.beginPath(); g.arc(at[0], at[1], size, 0, 7); g.fill(); g.stroke();
    if (data.particles.length <= 12) {
      g.font = "13px system-ui,sans-serif"; g.textBaseline = "bottom";
      const inside = at[0] + size + 6 + g.measureText(particle.name).width < scene.w;
      const x = at[0] + (inside ? 1 : -1) * (size + 2), y = Math.max(16, at[1] - size * 0.4);
      g.textAlign = inside ? "left" : "right";
      g.strokeStyle = colours.well; g.lineWidth = 3; g.strokeText(particle.name, x, y);
      g.fillStyle = colours.ink; g.fillText(particle.name, x, y);
    }
  }

  const hasParticle = new Set(data.particles.map(p => p.point));
  const joints = [...new Set(data.links.flatMap(l => [l.from, l.to])
    .concat(data.bodies.flatMap(b => b.arms || [])))].filter(p => !hasParticle.has(p) &&
      !data.bodies.some(b => b.point === p));
  function drawScene() {
    const g = scene.begin();
    aim();
    drawGrid(g);
    data.particles.forEach((p, i) => drawTrail(g, p.point, colourOf(i)));
    data.bodies.forEach((b, i) => drawTrail(g, b.point, colourOf(data.particles.length + i)));
    const near = p => space ? project(where(p, frame))[2] : 0, things = [];
    data.links.forEach((l, i) => things.push([(near(l.from) + near(l.to)) / 2, 0, () => drawLink(g, i)]));
    data.bodies.forEach((b, i) => things.push([near(b.point), 1, () => drawBody(g, b, i)]));
    joints.forEach(p => things.push([near(p), 2, () => drawJoint(g, p)]));
    data.particles.forEach((p, i) => things.push([near(p.point), 3, () => drawParticle(g, p, i)]));
    things.sort((a, b) => space ? a[0] - b[0] || a[1] - b[1] : a[1] - b[1]);
    things.forEach(t => t[2]());
  }

  /* --- diagrams ---------------------------------------------------------------------- */

  function axes(g, s, x, y, xName, yName) {
    const pad = v => { const d = (v.hi - v.lo) * 0.06 || Math.abs(v.hi) * 0.1 || 1; return [v.lo - d, v.hi + d]; };
    const [x0, x1] = x.exact ? [x.lo, x.hi] : pad(x), [y0, y1] = pad(y);
    const left = 48, right = s.w - 10, top = 20, bottom = s.h - 36;
    const X = v => left + (v - x0) / (x1 - x0) * (right - left), Y = v => bottom - (v - y0) / (y1 - y0) * (bottom - top);
    g.font = "11px system-ui,sans-serif"; g.lineWidth = 1;
    const sx = niceStep(x1 - x0, 5), sy = niceStep(y1 - y0, 5);
    g.textAlign = "center"; g.textBaseline = "top";
    for (let k = Math.ceil(x0 / sx - 1e-9); k * sx <= x1 + 1e-9 * sx; k++) {
      g.strokeStyle = colours.grid; line(g, [[X(k * sx), top], [X(k * sx), bottom]]); g.stroke();
      g.fillStyle = colours.faint; g.fillText(short(k * sx, sx), X(k * sx), bottom + 4);
    }
    g.textAlign = "right"; g.textBaseline = "middle";
    for (let k = Math.ceil(y0 / sy - 1e-9); k * sy <= y1 + 1e-9 * sy; k++) {
      g.strokeStyle = colours.grid; line(g, [[left, Y(k * sy)], [right, Y(k * sy)]]); g.stroke();
      g.fillStyle = colours.faint; g.fillText(short(k * sy, sy), left - 5, Y(k * sy));
    }
    g.strokeStyle = colours.line; g.strokeRect(left, top, right - left, bottom - top);
    g.fillStyle = colours.ink; g.font = "12px system-ui,sans-serif";
    g.textAlign = "left"; g.textBaseline = "alphabetic"; g.fillText(yName, 6, 13);
    g.textAlign = "right"; g.fillText(xName, right, s.h - 7);
    return { X, Y, left, right, top, bottom };
  }

  function drawPhase() {
    const state = data.states[stateShown], g = phase.begin(), q = channels[state.q], v = channels[state.v];
    const a = axes(g, phase, q, v, state.name, state.rate);
    const course = upTo => {
      const points = [], step = Math.max(1, Math.floor(frames / 4000));
      for (let k = 0; k < upTo; k += step) points.push([a.X(read(q, k)), a.Y(read(v, k))]);
      points.push([a.X(read(q, upTo)), a.Y(read(v, upTo))]);
      return points;
    };
    g.strokeStyle = colours.faint; g.globalAlpha = 0.4; g.lineWidth = 1;
    line(g, course(frames - 1)); g.stroke();
    g.globalAlpha = 1;
    g.strokeStyle = colours.c0; g.lineWidth = 1.3; line(g, course(frame)); g.stroke();
    g.fillStyle = colours.c1; g.beginPath();
    g.arc(a.X(read(q, frame)), a.Y(read(v, frame)), 4.5, 0, 7); g.fill();
  }

  function drawEnergies() {
    const g = energy.begin(), list = data.energies.map(e => channels[e.channel]);
    const t = { lo: Math.min(data.t0, data.t1), hi: Math.max(data.t0, data.t1), exact: true };
    if (!(t.hi > t.lo)) t.hi = t.lo + 1;
    const y = { lo: Math.min(...list.map(c => c.lo)), hi: Math.max(...list.map(c => c.hi)) };
    const a = axes(g, energy, t, y, data.unit ? `t [${data.unit}]` : "t", ""), inks = [colours.c1, colours.c0, colours.ink];
    const dashes = [[], [5, 3], []], wide = [1.4, 1.4, 2]; /* they differ in grey too */
    list.forEach((c, i) => {
      const points = [], step = Math.max(1, Math.floor(frames / 1500));
      for (let k = 0; k < frames; k += step) points.push([a.X(timeAt(k)), a.Y(read(c, k))]);
      points.push([a.X(timeAt(frames - 1)), a.Y(read(c, frames - 1))]);
      const key = a.left + i * (a.right - a.left) / 3;
      g.strokeStyle = g.fillStyle = inks[i % 3]; g.lineWidth = wide[i % 3]; g.setLineDash(dashes[i % 3]);
      line(g, points); g.stroke();
      line(g, [[key, 9], [key + 18, 9]]); g.stroke();
      g.setLineDash([]);
      g.beginPath(); g.arc(a.X(timeAt(frame)), a.Y(read(c, frame)), 3.2, 0, 7); g.fill();
      g.textAlign = "left"; g.textBaseline = "alphabetic"; g.font = "12px system-ui,sans-serif";
      g.fillText(data.energies[i].name, key + 23, 13);
    });
    g.strokeStyle = colours.faint; g.lineWidth = 1;
    line(g, [[a.X(timeAt(frame)), a.top], [a.X(timeAt(frame)), a.bottom]]); g.stroke();
  }

  function draw() {
    readColours();
    const step = niceStep(seconds, 400);
    clock.textContent = "t = " + short(timeAt(frame), Math.min(step, 1)) + (data.unit ? " " + data.unit : "");
    drawScene();
    if (data.states.length > 0) drawPhase();
    if (data.energies.length > 0) drawEnergies();
  }

  if (space) {
    scene.canvas.classList.add("turns");
    let held = null;
    scene.canvas.onpointerdown = e => { held = [e.clientX, e.clientY, yaw, pitch];
                                        scene.canvas.setPointerCapture(e.pointerId); };
    scene.canvas.onpointermove = e => {
      if (!held) return;
      yaw = held[2] - (e.clientX - held[0]) * 0.01;
      pitch = Math.max(-1.57, Math.min(1.57, held[3] + (e.clientY - held[1]) * 0.01));
      draw();
    };
    scene.canvas.onpointerup = scene.canvas.onpointercancel = () => { held = null; };
    scene.canvas.ondblclick = () => { yaw = -0.6; pitch = 0.32; draw(); };
  }
  new ResizeObserver(draw).observe(section);
  window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", draw);
  window.matchMedia("print").addEventListener("change", draw);
  window.addEventListener("beforeprint", draw);
  window.addEventListener("afterprint", draw);
  section.qdot = { seek: t => seek((t - data.t0) / ((data.t1 - data.t0) || 1) * (frames - 1)),
                   time: () => timeAt(frame), play };
  play(!window.matchMedia("(prefers-reduced-motion: reduce)").matches);
  draw();
}

document.querySelectorAll("section.animation").forEach(section => new Animation(section));
})();
