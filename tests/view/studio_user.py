"""Somebody who uses the studio by pointer and keyboard."""

import json
import time

from support import PATIENCE

ALT, CONTROL, SHIFT = 1, 2, 8
OPENED = "document.querySelector('#outline .row') && document.querySelector('#inspector p') && window.studio.scene.version > 0"

# A table in daylight, and nothing on it.
EMPTY = """{
  "version": 1,
  "meshes": [{"floor": {"height": -1, "material": {"coated": {"color": {"wood": {"axis": [1, 0.1, 0.02], "pith": [0, 0, -4]}}, "roughness": 0.25}}}}],
  "lights": [{"sky": {"sun_elevation": 30, "sun_azimuth": -50}}],
  "camera": {"position": [0, -6.5, 3.2], "look_at": [0.1, 0, -0.15], "fov": 25},
  "render": {"width": 480, "height": 360, "samples": 64, "exposure": 0.8}
}
"""


class User:
    def __init__(self, browser):
        self.browser = browser

    def open(self, url):
        self.browser.open(url)
        self.until(OPENED)

    def until(self, condition, within=60):
        return self.browser.wait_for(f"Boolean({condition})", within * PATIENCE)

    def step(self, action):
        """Does something, and waits until the scene has changed by it."""
        self.browser.run("window.textBefore = studio.scene.text")
        action()
        self.until("studio.scene.text !== window.textBefore && !studio.scene.isBusy")

    def drag(self, start, end):
        """Drags, and waits until the scene follows no more."""
        self.step(lambda: self.browser.drag(start, end))
        last, since = None, time.monotonic()
        while time.monotonic() - since < 0.5 * PATIENCE:
            now = self.browser.run("studio.scene.isBusy ? null : studio.scene.text")
            if now is None or now != last:
                last, since = now, time.monotonic()
            time.sleep(0.05)

    # ---- by the pointer

    def place(self, element):
        """The middle of an element, which an expression or a selector names."""
        if not element.startswith(("document", "[...")):
            element = f"document.querySelector({json.dumps(element)})"
        self.until(f"({element})?.getBoundingClientRect().width > 0")
        box = self.browser.run(f"(() => {{ const e = {element}; e.scrollIntoView({{block: 'nearest'}});"
                               " return e.getBoundingClientRect().toJSON(); })()")
        return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    def click(self, element, modifiers=0, button="left"):
        x, y = self.place(element)
        self.browser.mouse("mouseMoved", x, y)
        self.browser.mouse("mousePressed", x, y, button=button, clickCount=1, modifiers=modifiers)
        self.browser.mouse("mouseReleased", x, y, button=button, clickCount=1, modifiers=modifiers)

    @staticmethod
    def named(selector, text):
        """An element of a sort whose text begins with something."""
        return f"[...document.querySelectorAll({json.dumps(selector)})].find((e) => e.textContent.trim().startsWith({json.dumps(text)}))"

    def row(self, name):
        return self.named("#outline .row", name)

    def menu(self, text):
        self.until("document.querySelector('.menu:popover-open')")
        self.step(lambda: self.click(self.named(".menu .item", text)))

    def wrap(self, text):
        self.click("#wrap")
        self.menu(text)

    def choose(self, words):
        """The first of what the palette finds."""
        self.until("document.querySelector('dialog.palette .card')")
        self.type(words)
        self.step(lambda: self.browser.press("Enter", "Enter", "\r"))

    def new_material(self, name):
        self.click("[aria-label='Add to materials']")
        self.menu(name)

    # ---- by the keyboard

    def type(self, text):
        for key in text:
            self.browser.press(key, "", key)

    def key(self, key, modifiers=0):
        self.browser.press(key, f"Key{key.upper()}" if len(key) == 1 else key, modifiers=modifiers)

    def set_number(self, parameter, *values):
        """Clicks a number in the inspector, and types others into it and the numbers after it."""
        self.click(f"[data-parameter={parameter}] .number")
        for i, value in enumerate(values):
            if i > 0:
                self.browser.press("Tab")
            self.browser.run("document.activeElement.select()")
            if self.browser.run("document.activeElement.value") == value:
                continue
            self.type(value)
            self.step(lambda: self.browser.press("Enter"))


def build_glass_of_water(user, taken=lambda name: None):
    """A glass of water with ice, from a scene without an object. `taken` is called after each step of the tutorial."""
    taken("empty")
    user.step(lambda: user.click("#empty-start"))
    taken("ball")
    user.new_material("Water")
    user.new_material("Ice")
    # A wall of glass around water.
    user.click(user.row("Glass sphere"))
    user.click("[data-action=replace]")
    user.until("document.querySelector('dialog.palette .card')")
    user.type("thin shell")
    taken("palette")
    user.step(lambda: user.browser.press("Enter", "Enter", "\r"))
    user.set_number("half_thickness", "0.04")
    taken("shell")
    # A flat base, in the shape that the wall follows.
    user.click(user.row("Sphere"))
    user.wrap("Cut by a plane, with a round edge")
    # The table reaches a little into the base.
    user.click(user.row("Floor"))
    user.set_number("height", "-0.78")
    user.click(user.row("Glass filled with water"))
    # Only the water ends at its level …
    user.wrap("Cut by a plane")
    user.click("[data-parameter=phases] .choice")
    user.menu("water")
    user.click(user.row("Plane"))
    user.set_number("offset", "0.25")
    taken("level")
    # … and everything ends at the rim.
    user.click(user.row("Keep water inside plane"))
    user.wrap("Cut by a plane")
    user.click(user.row("Plane"))
    user.set_number("offset", "0.6")
    taken("rim")
    # Ice, over the glass and thereby in the water.
    user.click(user.row("Keep all inside plane"))
    user.click("#add")
    user.choose("rounded box")
    user.set_number("size", "0.5", "0.5", "0.5")
    user.set_number("radius", "0.08")
    user.wrap("Rotate")
    user.set_number("angle", "25")
    user.wrap("Move")
    user.set_number("by", "-0.25", "-0.2", "0.3")
    taken("ice")


BOWL = {"smooth_intersection": {"radius": 0.1, "of": [{"sphere": {"radius": 1}}, {"plane": {"normal": [0, 0, -1], "offset": 0.75}}]}}
FILLED = {"thin_shell": {"of": BOWL, "shell": "glass", "inside": "water", "half_thickness": 0.04}}
POURED = {"intersect_shape": {"shape": {"plane": {"offset": 0.25}}, "of": FILLED, "phases": "water"}}
ICE = {"set": {"phase": "ice", "of": {"rounded_box": {"size": [0.5, 0.5, 0.5], "radius": 0.08}}}}
GLASS_OF_WATER = {"over": [
    {"translate": {"by": [-0.25, -0.2, 0.3], "of": {"rotate": {"axis": [0, 0, 1], "angle": 25, "of": ICE}}}},
    {"intersect_shape": {"shape": {"plane": {"offset": 0.6}}, "of": POURED}}]}
