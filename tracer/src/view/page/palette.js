// The palette: everything that can be added, with pictures, by chapters and words.
import {summaryOf} from "./catalogue.js";
import {combiningFigure, isCombining} from "./combining.js";
import {openDialog} from "./dialog.js";
import {make} from "./dom.js";
import {icon, iconOf} from "./icons.js";

const mostRecent = 8, stored = "phasetree.recent";
const chapterTitle = (chapter) => {
  const text = chapter.replaceAll("-", " ");
  return text.charAt(0).toUpperCase() + text.slice(1);
};

function recent() {
  try {
    return JSON.parse(localStorage.getItem(stored) ?? "[]");
  } catch {
    return [];
  }
}

function remember(kind) {
  const key = `${kind.type} ${kind.kind}`;
  try {
    localStorage.setItem(stored, JSON.stringify([key, ...recent().filter((k) => k !== key)].slice(0, mostRecent)));
  } catch {
    // The browser keeps nothing for this page.
  }
}

function score(kind, words) {
  const name = `${kind.kind} ${kind.title}`.toLowerCase(), all = `${name} ${kind.help} ${kind.chapter}`.toLowerCase();
  if (!words.every((word) => all.includes(word))) return 0;
  const inName = words.filter((word) => name.includes(word)).length;
  return 1 + inName + (name.startsWith(words[0] ?? "") ? 2 : 0);
}

// Lets the person choose one of the kinds; resolves with it, or null.
export function choose(title, kinds) {
  return new Promise((answer) => {
    let chosen = null, chapter = null;
    const chapters = [...new Set(kinds.map((kind) => kind.chapter))];
    const search = make("input", {
      type: "search", class: "line", placeholder: "Search: glass, round, repeat …", spellcheck: false, autocomplete: "off", "aria-label": "Search",
      oninput: () => showCards(),
    });
    const list = make("div", {class: "chapters", role: "group", "aria-label": "Chapters"});
    const cards = make("div", {class: "cards"});
    const status = make("p", {class: "faint", role: "status"});
    const take = (kind) => {
      chosen = kind;
      remember(kind);
      dialog.close();
    };
    const card = (kind) => make("button", {type: "button", class: "card", title: summaryOf(kind.help), "data-kind": kind.kind, "data-type": kind.type, onclick: () => take(kind)},
      kind.picture ? make("img", {src: kind.picture, alt: "", loading: "lazy", width: 96, height: 72}) : make("span", {class: "no-picture"}, icon(iconOf(kind))),
      make("span", {class: "card-title"}, kind.title));
    // Operators between phases are explained before they are chosen.
    const explained = (inside) => {
      const combining = inside.filter(isCombining);
      if (combining.length < 2) return [];
      return [combiningFigure(null, combining.map((kind) => kind.kind), (name) => take(combining.find((kind) => kind.kind === name)))];
    };
    const group = (name, inside) => (inside.length === 0 ? [] : [make("h3", {}, name), ...explained(inside), make("div", {class: "grid"}, inside.map(card))]);
    const showCards = () => {
      const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
      const found = kinds.filter((kind) => (words.length > 0 || chapter === null || kind.chapter === chapter) && score(kind, words) > 0);
      found.sort((a, b) => score(b, words) - score(a, words));
      const keys = recent(), latest = words.length === 0 && chapter === null
        ? keys.map((key) => kinds.find((kind) => `${kind.type} ${kind.kind}` === key)).filter(Boolean) : [];
      const shown = words.length > 0 ? [make("div", {class: "grid"}, found.map(card))]
        : [...(latest.length === 0 ? [] : [make("h3", {}, "Recent"), make("div", {class: "grid"}, latest.map(card))]), ...chapters.filter((c) => chapter === null || c === chapter).flatMap((c) => group(chapterTitle(c), found.filter((kind) => kind.chapter === c)))];
      cards.replaceChildren(...shown);
      cards.scrollTop = 0;
      status.textContent = found.length === 0 ? "No matches" : `${found.length} found`;
      for (const button of list.children) button.setAttribute("aria-pressed", String(words.length === 0 && (button.dataset.chapter || null) === chapter));
    };
    const chapterButton = (name, text) => make("button", {type: "button", "data-chapter": name ?? "", onclick: () => {
      chapter = name;
      search.value = "";
      showCards();
    }}, text);
    const dialog = openDialog(title, "palette", () => [make("div", {class: "search"}, icon("search"), search, status), make("div", {class: "columns"}, list, cards)]);
    list.append(chapterButton(null, "All"), ...chapters.map((name) => chapterButton(name, chapterTitle(name))));
    dialog.addEventListener("keydown", (event) => {
      const all = [...cards.querySelectorAll(".card")], at = all.indexOf(document.activeElement);
      const columns = all.length > 0 ? Math.max(1, Math.floor(cards.clientWidth / (all[0].offsetWidth + 8))) : 1;
      const by = {ArrowRight: 1, ArrowLeft: -1, ArrowDown: columns, ArrowUp: -columns}[event.key];
      if (event.key === "Enter" && document.activeElement === search && all.length > 0) {
        event.preventDefault();
        all[0].click();
      } else if (by && at >= 0) {
        event.preventDefault();
        (all[at + by] ?? (by < 0 ? search : all.at(-1))).focus();
      } else if (event.key === "ArrowDown" && document.activeElement === search) {
        event.preventDefault();
        all[0]?.focus();
      }
    });
    dialog.addEventListener("close", () => answer(chosen));
    showCards();
    search.focus();
  });
}
