// JSON pointers (RFC 6901).

export const escaped = (key) => String(key).replaceAll("~", "~0").replaceAll("/", "~1");
export const joined = (pointer, ...keys) => keys.reduce((all, key) => `${all}/${escaped(key)}`, pointer);
export const parentOf = (pointer) => pointer.slice(0, Math.max(0, pointer.lastIndexOf("/")));
export const keysOf = (pointer) => pointer.split("/").slice(1).map((key) => key.replaceAll("~1", "/").replaceAll("~0", "~"));
export const lastKey = (pointer) => keysOf(pointer).at(-1) ?? "";
export const isWithin = (pointer, outer) => pointer === outer || pointer.startsWith(`${outer}/`);
