// Tabs, of which one is shown. On wide windows the outline stands beside them instead of being one.

export class Tabs {
  #buttons;

  constructor(list) {
    this.#buttons = [...list.querySelectorAll("[role=tab]")];
    for (const button of this.#buttons) button.addEventListener("click", () => this.show(button.dataset.tab));
    list.addEventListener("keydown", (event) => {
      const shown = this.#buttons.filter((button) => button.offsetParent !== null), at = shown.indexOf(document.activeElement);
      const by = {ArrowRight: 1, ArrowLeft: -1}[event.key];
      if (!by || at < 0) return;
      const next = shown[(at + by + shown.length) % shown.length];
      this.show(next.dataset.tab);
      next.focus();
    });
  }
  get shown() {
    return document.body.dataset.tab;
  }
  show(name) {
    document.body.dataset.tab = name;
    for (const button of this.#buttons) {
      const isShown = button.dataset.tab === name;
      button.setAttribute("aria-selected", String(isShown));
      button.tabIndex = isShown ? 0 : -1;
    }
  }
}
