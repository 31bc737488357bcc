// Fits the picture and the overlays drawn over it into the available space.

const most = 2.5; // times as large as its pixels

export function fitPicture(stage, canvas, overlays, shown) {
  const fit = () => {
    if (canvas.width <= 1) return;
    const {clientWidth, clientHeight} = stage;
    const factor = Math.min(most, clientWidth / canvas.width, clientHeight / canvas.height);
    const width = Math.max(1, Math.floor(canvas.width * factor)), height = Math.max(1, Math.floor(canvas.height * factor));
    Object.assign(canvas.style, {width: `${width}px`, height: `${height}px`});
    for (const svg of overlays)
      Object.assign(svg.style, {left: `${canvas.offsetLeft}px`, top: `${canvas.offsetTop}px`, width: `${width}px`, height: `${height}px`});
    shown();
  };
  new ResizeObserver(fit).observe(stage);
  return fit;
}
