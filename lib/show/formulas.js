/* formulas.js -- formulas on a page where no font for mathematics is installed: letters that no font
 * has become italics of the text, and brackets and roots that do not grow are drawn as lines. */
"use strict";
(function () {
const maths = document.querySelectorAll("math");
if (maths.length === 0 || typeof MathMLElement === "undefined") return;
const NS = maths[0].namespaceURI;

/* Whether a letter looks like U+1D6A6, which there is not. */
function isMissing(letter) {
  const canvas = document.createElement("canvas"), g = canvas.getContext("2d");
  canvas.width = canvas.height = 60;
  const look = text => {
    g.clearRect(0, 0, 60, 60);
    g.font = "40px " + getComputedStyle(maths[0]).fontFamily;
    g.textBaseline = "middle";
    g.fillText(text, 10, 30);
    return canvas.toDataURL();
  };
  return look(letter) === look("\u{1d6a6}");
}

function mathOf(inside) {
  const m = document.createElementNS(NS, "math");
  m.innerHTML = inside;
  m.style.cssText = "position:absolute;visibility:hidden;font-size:20px";
  document.body.appendChild(m);
  return m;
}

/* Whether a bracket about something 120 high grows. */
function bracketsGrow() {
  const m = mathOf('<mrow><mo>(</mo><mspace height="60px" depth="60px"></mspace><mo>)</mo></mrow>');
  const grown = m.querySelector("mo").getBoundingClientRect().height > 80;
  m.remove();
  return grown;
}

function rootsGrow() {
  const m = mathOf('<msqrt><mspace width="9px" height="60px" depth="60px"></mspace></msqrt><mo>\u221a</mo>');
  const root = m.querySelector("msqrt").getBoundingClientRect(), sign = m.querySelector("mo").getBoundingClientRect();
  m.remove();
  return root.width - 9 > 1.15 * sign.width; /* of a sign that grows the stem is added */
}

function setLetters() {
  for (const m of maths) m.style.fontFamily = '"DejaVu Serif","Liberation Serif","Times New Roman",serif';
  for (const i of document.querySelectorAll("mi"))
    if ([...i.textContent].length === 1) { i.style.textTransform = "none"; i.style.fontStyle = "italic"; }
}

const heightOf = e => e.getBoundingClientRect().height;

/* The brackets of a tall row as its left and right edge. */
function drawBrackets() {
  for (const row of document.querySelectorAll("math mrow")) {
    const first = row.firstElementChild, last = row.lastElementChild;
    if (!first || first === last || first.textContent !== "(" || last.textContent !== ")") continue;
    if (first.localName !== "mo" || heightOf(row) < 1.5 * parseFloat(getComputedStyle(first).fontSize)) continue;
    first.style.display = last.style.display = "none";
    row.style.cssText += "border:0 solid;border-width:0 1.4px;border-radius:0.55em/50%;padding:0 0.3em;margin:0 0.15em";
  }
}

/* Innermost first: a root as a sign that is stretched and a row with a line above it. */
function drawRoots() {
  for (const root of [...document.querySelectorAll("math msqrt")].reverse()) {
    const all = document.createElementNS(NS, "mrow"), sign = document.createElementNS(NS, "mo");
    const row = document.createElementNS(NS, "mrow");
    sign.textContent = "\u221a";
    row.append(...root.childNodes);
    row.style.cssText = "border-top:1.2px solid;padding:0.1em 0.1em 0";
    all.append(sign, row);
    root.replaceWith(all);
    const box = row.getBoundingClientRect(), own = sign.getBoundingClientRect();
    const grow = box.height / (0.95 * parseFloat(getComputedStyle(sign).fontSize));
    sign.style.cssText = "transform-origin:100% 100%;transform:translateY(" + (box.bottom - own.bottom + 0.14 * own.height * grow) +
      "px) scaleY(" + grow + ")";
  }
}

const bare = isMissing("\u{1d703}") || isMissing("\u{1d45a}");
if (bare) setLetters();
if (!bracketsGrow()) drawBrackets();
if (!rootsGrow()) drawRoots();
})();
