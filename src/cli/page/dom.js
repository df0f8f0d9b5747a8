/**
 * What `element` takes as a child: text is set as text, never read as markup;
 * `null`, `undefined` and `false` are left out.
 * @typedef {Node | string | number | null | undefined | false} Child
 */

/**
 * Value of an attribute. A name that begins with `on` takes a listener of the
 * event (`onclick`, `onpointerdown`); `true` sets an attribute without a value;
 * `false`, `null` and `undefined` leave it out.
 * @typedef {string | number | boolean | null | undefined | ((event: any) => void)} AttributeValue
 */

/**
 * Creates an HTML element with attributes, listeners and children.
 * @template {keyof HTMLElementTagNameMap} Tag
 * @param {Tag} tag
 * @param {Record<string, AttributeValue>} [attributes]
 * @param {...(Child | Child[])} children
 * @returns {HTMLElementTagNameMap[Tag]}
 */
export function element(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    setAttribute(node, name, value);
  }
  append(node, ...children);
  return node;
}

/**
 * Appends children as `element` does.
 * @param {Node} node
 * @param {...(Child | Child[])} children
 */
export function append(node, ...children) {
  for (const child of children.flat()) {
    if (child === null || child === undefined || child === false) continue;
    node.appendChild(child instanceof Node ? child : document.createTextNode(String(child)));
  }
}

/**
 * Removes all children.
 * @template {Node} Kind
 * @param {Kind} node
 * @returns {Kind}
 */
export function clear(node) {
  while (node.firstChild) node.removeChild(node.firstChild);
  return node;
}

/**
 * Text in which what stands between backticks is code.
 * @param {string} text
 */
export function withCode(text) {
  return text.split("`").map((part, k) => (k % 2 === 1 ? element("code", {}, part) : part));
}

/**
 * @param {HTMLElement} node
 * @param {string} name
 * @param {AttributeValue} value
 */
function setAttribute(node, name, value) {
  if (value === null || value === undefined) return;
  if (typeof value === "function") {
    if (!name.startsWith("on")) throw new TypeError(`${name} is not the name of a listener`);
    node.addEventListener(name.slice(2), value);
    return;
  }
  // aria-* attributes tell "false" from absent.
  if (name.startsWith("aria-")) {
    node.setAttribute(name, String(value));
    return;
  }
  if (value === false) return;
  node.setAttribute(name, value === true ? "" : String(value));
}
