"""Makes the pictures of the documents' Python blocks small."""

import phasetree as pt

image, render = pt.image, pt.Scene.render


def small_image(*arguments, **settings):
    return image(*arguments[2:], **{**settings, "width": 24, "height": 18, "samples": 1})


def small_render(scene, *arguments, **settings):
    settings.pop("time_limit", None)
    return render(scene, **{**settings, "samples": 8 if settings.get("denoise") else 1})


pt.image, pt.Scene.render = small_image, small_render
