// The list of phases, a checkbox each. They are made anew only if their names change, so that the focus stays.

export function showPhases(fieldset, phases, changed) {
  const boxes = [...fieldset.querySelectorAll("input")];
  const isSame = boxes.length === phases.length && boxes.every((box, i) => box.value === phases[i].name);
  if (!isSame) {
    fieldset.querySelectorAll("label").forEach((label) => label.remove());
    for (const phase of phases) {
      const label = document.createElement("label"), box = document.createElement("input");
      box.type = "checkbox";
      box.value = phase.name;
      box.addEventListener("change", () => {
        const hidden = [...fieldset.querySelectorAll("input")].filter((b) => !b.checked).map((b) => b.value);
        changed(hidden);
      });
      label.append(box, phase.name);
      fieldset.append(label);
    }
  }
  fieldset.querySelectorAll("input").forEach((box, i) => { box.checked = !phases[i].hidden; });
}
