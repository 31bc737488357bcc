// What is at a point: its phase, the distances there, and the crossings along the ray.

const number = (x) => (Math.abs(x) >= 1e-3 && Math.abs(x) < 1e5 ? x.toFixed(4) : x.toPrecision(4));

function table(caption, heads, rows) {
  const made = document.createElement("table");
  made.createCaption().textContent = caption;
  const head = made.createTHead().insertRow();
  for (const text of heads) {
    const cell = document.createElement("th");
    cell.scope = "col";
    cell.textContent = text;
    head.append(cell);
  }
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

export function showPoint(section, told) {
  const said = document.createElement("p");
  const at = told.point.map(number).join(", ");
  said.textContent = told.met ? `${told.met} at (${at}).` : "Nothing is met there.";
  const parts = [said];
  if (told.distances.length > 0)
    parts.push(table("Φ just before it", ["phase", "Φ"], told.distances.map((d) => [d.phase, d.phi])));
  if (told.crossings.length > 0) {
    const caption = `Crossings along the ray, which starts in ${told.start}` + (told.has_more ? "; there are more" : "");
    parts.push(table(caption, ["distance", "from", "to"], told.crossings.map((c) => [c.distance, c.from, c.to])));
  }
  section.replaceChildren(section.querySelector("h2"), ...parts);
}
