// Converts between linear Rec.709, used by the server, and hexadecimal sRGB, used by browsers (IEC 61966-2-1).

const encoded = (x) => x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055;

// A colour that the page itself has just sent is already hexadecimal.
export function hexOf(colour) {
  if (typeof colour === "string") return colour;
  const digits = colour.map((x) => Math.round(255 * encoded(Math.max(0, Math.min(1, x)))).toString(16).padStart(2, "0"));
  return `#${digits.join("")}`;
}
