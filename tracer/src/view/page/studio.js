// The editor: outline, inspector, palette, text and handles, around one document.
import {Actions} from "./actions.js";
import {Announcer} from "./announcer.js";
import {Catalogue} from "./catalogue.js";
import {setMeasuredColours} from "./colour_field.js";
import {SceneDocument} from "./document.js";
import {Grab} from "./grab.js";
import {Handles} from "./handles.js";
import {Inspector} from "./inspector.js";
import {listenForKeys, showKeys} from "./keys.js";
import {Outliner} from "./outliner.js";
import {hiddenParts} from "./hidden_parts.js";
import {nameOf} from "./names.js";
import {Selection} from "./selection.js";
import {SelectionOutline} from "./selection_outline.js";
import {askCatalogue, pause, shortMessage} from "./server.js";
import {chainOf, isNode, isSection, membersOf, partsAlong} from "./structure.js";
import {mapTo, transformPoint} from "./affine.js";
import {present} from "./keyframes.js";
import {whenReleased} from "./press.js";
import {TextDrawer} from "./text_drawer.js";
import {Timeline} from "./timeline.js";

const pauseOfSaving = 700; // milliseconds
const element = (id) => document.getElementById(id);

export class Studio {
  #whenOutlined = null; // a selection that was made before the outline arrived
  #catalogue = null;
  #unsaved = null;   // timer
  #saveError = null; // the last one that was shown
  #isReady = false; // whether the catalogue and the scene have arrived
  #makeReady;
  #ready = new Promise((done) => (this.#makeReady = done));

  // `view` has canvas, camera(), radius(), tabs, lookAt(centre), hide(phase, isHidden), hideParts(pointers, isHidden), inspect(event), seek(seconds),
  // togglePlay(), changed() and lost(error).
  constructor(view) {
    this.view = view;
    this.scene = new SceneDocument();
    this.selection = new Selection();
    this.announcer = new Announcer(element("toasts"));
    this.actions = new Actions({scene: this.scene, selection: this.selection, announcer: this.announcer, radius: view.radius});
    const common = {scene: this.scene, selection: this.selection};
    const failed = (error) => {
      if (error.isOutdated) this.announcer.say(shortMessage(error), {isWrong: true});
    };
    this.outliner = new Outliner({tree: element("outline"), search: element("outline-search")}, {...common, act: {
      menu: (entry, row) => this.actions.menu(entry, row),
      drop: (entry, to) => this.actions.drop(entry, to),
      rename: (entry) => this.actions.rename(entry),
      add: (section) => this.actions.addToSection(section),
      hide: (phase, isHidden) => view.hide(phase, isHidden),
      hideParts: (pointers, isHidden) => view.hideParts(pointers, isHidden),
      openEdit: () => this.#openEdit(),
    }});
    this.inspector = new Inspector({head: element("inspector-head"), body: element("inspector")}, {...common, act: this.actions, radius: view.radius, failed});
    this.handles = new Handles(element("handles"), {view, scene: this.scene, failed: (error) => this.announcer.say(shortMessage(error), {isWrong: true})});
    this.selectionOutline = new SelectionOutline(element("selected-outline"), {...common, status: element("selected-said"), nameOf: (entry) => nameOf(entry, this.#catalogue)});
    this.grab = new Grab({canvas: view.canvas, mark: element("grab-mark"), panel: element("grab-panel"), button: element("grab"), scene: this.scene,
      announcer: this.announcer, inspect: (event) => view.inspect(event)});
    this.text = new TextDrawer({drawer: element("drawer"), area: element("text"), lines: element("text-lines"), problem: element("text-problem"), names: element("text-names")}, this.scene);
    this.timeline = new Timeline(element("timeline"), this.scene, {
      entry: () => this.actions.active, catalogue: () => this.#catalogue, seek: view.seek, togglePlay: view.togglePlay,
      failed: (error) => this.announcer.say(shortMessage(error), {isWrong: true}),
    });
    this.scene.addEventListener("change", (event) => this.#changed(event.detail));
    this.selection.addEventListener("change", () => this.#selected());
    document.addEventListener("cancelgesture", (event) => this.scene.takeBack(event.detail).catch((error) => this.announcer.say(shortMessage(error), {isWrong: true})));
    document.addEventListener("nonsense", (event) => this.announcer.say(`“${event.detail.slice(0, 40)}” is not a number. Type one such as 0.5, 2e-3 or 1/3.`, {isWrong: true}));
    this.#connectButtons();
  }
  // Without a file, as for objects made in Python, there is nothing to edit, and only the view remains.
  async start() {
    while (!this.#catalogue) {
      try {
        this.#catalogue = new Catalogue(await askCatalogue());
      } catch (error) {
        if (error.status === 404) {
          document.body.dataset.studio = "off";
          this.view.tabs.show("view");
          this.#isReady = true;
          return;
        }
        this.view.lost(error);
        await pause(1000);
      }
    }
    this.scene.follow((error) => this.view.lost(error));
    this.actions.catalogue = this.text.catalogue = this.handles.catalogue = this.#catalogue;
    setMeasuredColours(this.#catalogue.measuredColours);
    this.outliner.use(this.#catalogue);
    this.inspector.use(this.#catalogue);
    this.grab.use(this.#catalogue);
  }
  // Shows the scene at a time; `span` is the time from its first key to the last, or null.
  showTime(seconds, span) {
    if (present.seconds === seconds && JSON.stringify(present.span) === JSON.stringify(span)) return;
    Object.assign(present, {seconds, span});
    if (!this.#catalogue) return;
    this.inspector.show();
    this.handles.show();
    this.timeline.show();
  }
  #connectButtons() {
    const {actions} = this, run = {
      undo: () => actions.undo(), redo: () => actions.redo(), add: () => actions.add(), wrap: () => actions.wrapMenu(element("wrap")),
      duplicate: () => actions.duplicate(), delete: () => actions.delete(), "text-toggle": () => this.#toggleText(), help: showKeys,
      "save-file": () => this.scene.save().catch((error) => this.announcer.say(shortMessage(error), {isWrong: true})),
      "empty-add": () => actions.add(), "empty-start": () => actions.startWithBall(), "empty-scene": () => actions.startWith(element("empty-scene")), "whole-scene": () => actions.startWith(element("whole-scene")), frame: () => this.frame(), "outline-selection": () => this.#toggleOutline(),
    };
    for (const [id, act] of Object.entries(run)) element(id).addEventListener("click", () => this.#whenReady(act));
    listenForKeys(actions, {toggleText: () => this.#toggleText(), frame: () => this.frame(), toggleGrab: () => this.grab.toggle(), toggleOutline: () => this.#toggleOutline(), toggleHidden: () => this.#toggleHidden(), showAll: () => this.#showAll(), wrapButton: element("wrap"),
      whenReady: (act) => this.#whenReady(act)});
  }
  // What is pressed while the page still loads is done as soon as it has loaded.
  async #whenReady(act) {
    if (!this.#isReady) {
      this.announcer.say("The scene is still being loaded …");
      await this.#ready;
    }
    act();
  }
  #toggleText() {
    const isOpen = this.text.toggle();
    element("text-toggle").setAttribute("aria-pressed", String(isOpen));
    if (isOpen) this.text.reveal(this.actions.active?.line);
  }
  // Hides the selection, or shows it again if all of it is hidden.
  #toggleHidden() {
    const parts = this.actions.selected.filter(hiddenParts.canHide);
    if (parts.length === 0) return;
    const isHidden = !parts.every(hiddenParts.has);
    this.view.hideParts(parts.map(({pointer}) => pointer), isHidden);
    this.announcer.say(isHidden ? "Hidden in the picture, not in the file. Alt+H shows everything." : "Shown again");
  }
  #showAll() {
    if (hiddenParts.pointers.length > 0) this.view.hideParts(hiddenParts.pointers, false);
  }
  #toggleOutline() {
    this.selectionOutline.toggle(!this.selectionOutline.isOn);
    element("outline-selection").setAttribute("aria-pressed", String(this.selectionOutline.isOn));
  }
  #openEdit() {
    this.view.tabs.show("edit");
    element("inspector").querySelector("input, textarea, .choice")?.focus();
  }
  #changed({isFirst, isOwn}) {
    const {scene} = this;
    this.#isReady = true;
    this.#makeReady();
    this.selection.update(scene);
    this.outliner.show();
    if (scene.hasOutline) {
      this.#whenOutlined?.();
      this.#whenOutlined = null;
    }
    if (!isOwn) this.inspector.forgetFailures();
    this.inspector.show();
    this.text.show();
    this.timeline.show();
    this.handles.select(this.actions.active);
    element("undo").disabled = scene.undo === null;
    element("redo").disabled = scene.redo === null;
    element("undo").title = scene.undo === null ? "Nothing to undo" : `Undo: ${scene.undo} (Ctrl+Z)`;
    element("redo").title = scene.redo === null ? "Nothing to redo" : `Redo: ${scene.redo} (Ctrl+Shift+Z)`;
    this.#showSaved();
    element("empty").hidden = !scene.hasOutline || ["/tree", "section:objects"].some((key) => scene.entry(key));
    this.view.changed();
    if (!isFirst && !isOwn) this.announcer.say(scene.undo ? `Changed elsewhere: ${scene.undo}` : "Changed elsewhere");
  }
  // Every step is saved at once, so only what stays unsaved is worth a button.
  #showSaved() {
    const {saved, saveError} = this.scene, show = () => {
      const {saved, error} = this.scene;
      element("saved").textContent = !saved ? "Not saved" : error ? "Invalid file" : "Saved";
      element("saved").classList.toggle("wrong", saved && error !== null);
      element("saved").title = saved && error ? `The file is saved, but it has an error${error.line ? ` on line ${error.line}` : ""}: ${error.message}` : "";
      element("saved").classList.toggle("hidden-text", !this.scene.saved);
      element("save-file").hidden = this.scene.saved;
      element("save-file").title = this.scene.saveError ?? "Save the scene file";
    };
    clearTimeout(this.#unsaved);
    if (saved) show();
    else this.#unsaved = setTimeout(() => whenReleased().then(show), pauseOfSaving);
    if (saveError && saveError !== this.#saveError) this.announcer.say(`Not saved: ${saveError}`, {isWrong: true});
    this.#saveError = saveError;
  }
  #selected() {
    const {active} = this.actions;
    this.handles.select(active);
    this.timeline.show();
    if (active) this.outliner.reveal(active.key);
    this.text.reveal(active?.line);
    if (active && this.view.tabs.shown === "view") this.view.tabs.show("edit");
  }
  // The outline entry for a node's pointer, as the server reports it for a clicked point.
  entryOf(pointer) {
    return pointer === "" ? null : this.scene.entries.find((entry) => !isSection(entry) && (membersOf(entry) === pointer || entry.pointer === pointer)) ?? null;
  }
  // Selects what the picture shows at a point: first the whole thing, and with each further click a part of it.
  selectNodes(path, point = null) {
    if (point) this.actions.pointed = point;
    if (!this.scene.hasOutline) return void (this.#whenOutlined = () => this.selectNodes(path));
    const parts = partsAlong(path.map((node) => this.entryOf(node.pointer)).filter(Boolean));
    const next = parts[parts.indexOf(this.actions.active) + 1] ?? parts[0];
    this.selection.set(next ? [next.key] : []);
  }
  selectNode(pointer) {
    if (!this.scene.hasOutline) return void (this.#whenOutlined = () => this.selectNode(pointer));
    const entry = this.entryOf(pointer);
    if (!entry) return;
    this.selection.set([entry.key]);
    this.view.tabs.show("edit");
  }
  // Turns the camera towards the selection.
  frame() {
    const entry = this.actions.active;
    if (!entry || !isNode(entry)) return;
    this.view.lookAt(transformPoint(mapTo(chainOf(entry).at(-1)), [0, 0, 0]));
  }
}
