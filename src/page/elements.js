// Elements of the page: found by id, and made.

const $ = id => document.getElementById(id);

/** An element with text and attributes. */
function made(tag, attributes = {}, ...content) {
  const e = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) name === "hidden" ? e.hidden = value : e.setAttribute(name, value);
  e.append(...content);
  return e;
}
