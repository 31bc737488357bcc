// Shows what is at a point: its phase, the distances there, and the crossings along the ray.

const number = (x) => (Math.abs(x) >= 1e-3 && Math.abs(x) < 1e5 ? x.toFixed(4) : x.toPrecision(4));

function table(caption, heads, rows) {
  const made = document.createElement("table");
  made.createCaption().textContent = caption;
  const head = made.createTHead().insertRow();
  heads.forEach((text, i) => {
    const cell = document.createElement("th");
    cell.scope = "col";
    if (typeof rows[0]?.[i] === "number") cell.className = "number";
    cell.textContent = text;
    head.append(cell);
  });
  const body = made.createTBody();
  for (const row of rows) {
    const line = body.insertRow();
    for (const value of row) {
      const cell = line.insertCell();
      cell.textContent = typeof value === "number" ? number(value) : value;
      if (typeof value === "number") cell.className = "number";
    }
  }
  return made;
}

// The nodes that produced the surface, as buttons that select them. Nodes added by the view itself are in no file.
function nodes(path, showNode) {
  const first = path.findIndex((node) => node.line > 0);
  const list = document.createElement("ol");
  list.setAttribute("aria-label", "Nodes that produce this point, from the root of the tree");
  for (const node of first < 0 ? path.slice(-1) : path.slice(first)) {
    const item = document.createElement("li"), button = document.createElement("button");
    const place = node.line > 0 ? ` ${node.file.replace(/^.*\//, "")}:${node.line}:${node.column}` : " added by the viewer";
    Object.assign(button, {type: "button", textContent: node.name.replaceAll("_", " "), disabled: node.pointer === ""});
    button.addEventListener("click", () => showNode(node.pointer));
    item.append(button, place);
    list.append(item);
  }
  return list;
}

export function showPoint(section, told, showNode) {
  const sentence = document.createElement("p");
  const at = told.point.map(number).join(", ");
  sentence.textContent = told.met ? `${told.met} at (${at}).` : "There is nothing at this point.";
  const parts = [sentence];
  if (told.path.length > 0) parts.push(nodes(told.path, showNode));
  if (told.distances.length > 0)
    parts.push(table("Φ just before it", ["phase", "Φ"], told.distances.map((d) => [d.phase, d.phi])));
  if (told.crossings.length > 0) {
    const caption = `Interfaces along the ray, which starts in ${told.start}` + (told.has_more ? " (the first ones)" : "");
    parts.push(table(caption, ["distance", "from", "to"], told.crossings.map((c) => [c.distance, c.from, c.to])));
  }
  section.replaceChildren(section.querySelector("h2"), ...parts);
}
