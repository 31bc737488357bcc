// Converts between linear Rec.709, used by the server, hexadecimal sRGB, used by browsers (IEC 61966-2-1), and hue,
// saturation and value, used by people.

const encoded = (x) => x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055;
const decoded = (x) => x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4;

// A colour that the page itself has just sent is already hexadecimal.
export function hexOf(colour) {
  if (typeof colour === "string") return colour;
  const digits = colour.map((x) => Math.round(255 * encoded(Math.max(0, Math.min(1, x)))).toString(16).padStart(2, "0"));
  return `#${digits.join("")}`;
}

// The shares of red, green and blue of a hexadecimal colour, or null.
function sharesOf(hex) {
  const found = /^#?([0-9a-f]{6}|[0-9a-f]{3})$/i.exec(hex.trim());
  if (!found) return null;
  const digits = found[1].length === 3 ? [...found[1]].map((d) => d + d).join("") : found[1];
  return [0, 2, 4].map((i) => parseInt(digits.slice(i, i + 2), 16) / 255);
}

export const isHex = (text) => sharesOf(text) !== null;
export const linearOf = (hex) => sharesOf(hex).map((x) => Number(decoded(x).toPrecision(4)));

// Hue in degrees, saturation and value from 0 to 1.
export function hsvOf(hex) {
  const [r, g, b] = sharesOf(hex);
  const value = Math.max(r, g, b), chroma = value - Math.min(r, g, b);
  let hue = 0;
  if (chroma > 0) {
    if (value === r) hue = ((g - b) / chroma + 6) % 6;
    else if (value === g) hue = (b - r) / chroma + 2;
    else hue = (r - g) / chroma + 4;
  }
  return [60 * hue, value === 0 ? 0 : chroma / value, value];
}

export function hexOfHsv([hue, saturation, value]) {
  const share = (n) => {
    const k = (n + hue / 60) % 6;
    return value - value * saturation * Math.max(0, Math.min(k, 4 - k, 1));
  };
  return `#${[5, 3, 1].map((n) => Math.round(255 * share(n)).toString(16).padStart(2, "0")).join("")}`;
}
