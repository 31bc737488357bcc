// The picture on the canvas. Coarse pictures are scaled to the full size.

const small = document.createElement("canvas");

export function draw(canvas, state, pixels) {
  const {width, height} = state.picture;
  const image = new ImageData(width, height);
  for (let from = 0, to = 0; from < pixels.length; from += 3, to += 4) {
    image.data[to] = pixels[from];
    image.data[to + 1] = pixels[from + 1];
    image.data[to + 2] = pixels[from + 2];
    image.data[to + 3] = 255;
  }
  if (canvas.width !== state.width || canvas.height !== state.height) {
    canvas.width = state.width;
    canvas.height = state.height;
  }
  const context = canvas.getContext("2d");
  if (width === canvas.width && height === canvas.height) {
    context.putImageData(image, 0, 0);
    return;
  }
  small.width = width;
  small.height = height;
  small.getContext("2d").putImageData(image, 0, 0);
  context.drawImage(small, 0, 0, canvas.width, canvas.height);
}

// The pointer's position, in pixels of the whole picture.
export function place(canvas, event) {
  const box = canvas.getBoundingClientRect();
  const within = (share, size) => Math.max(0, Math.min(size, share * size));
  return [
    within((event.clientX - box.left) / box.width, canvas.width),
    within((event.clientY - box.top) / box.height, canvas.height),
  ];
}
