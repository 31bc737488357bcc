// Between linear Rec.709, as the server says it, and sRGB in hexadecimal digits, as browsers do (IEC 61966-2-1).

const encoded = (x) => x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055;

// A colour is also what the page itself has sent a moment ago, which is hexadecimal already.
export function hexOf(colour) {
  if (typeof colour === "string") return colour;
  const digits = colour.map((x) => Math.round(255 * encoded(Math.max(0, Math.min(1, x)))).toString(16).padStart(2, "0"));
  return `#${digits.join("")}`;
}
