// SPDX-License-Identifier: MIT
// Unpacks the page's blobs (gzip in base64) on first use, and keeps the result.
const unpacked = new Map();

function once(key, make) {
  if (!unpacked.has(key)) {
    unpacked.set(key, make());
  }
  return unpacked.get(key);
}

/** Returns a blob as a response, whose json(), text() or arrayBuffer() is its content. */
function blobOf(name) {
  const text = atob(document.getElementById("blob-" + name).textContent);
  const packed = Uint8Array.from(text, (letter) => letter.charCodeAt(0));
  return new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip")));
}

/** Returns a value of the page's data. */
function jsonOf(name) {
  return once(name, () => blobOf(name).json());
}

/** Runs a library's text as a script of the page. */
function libraryOf(name) {
  return once(name, async () => {
    const script = document.createElement("script");
    script.textContent = await blobOf(name).text();
    document.head.append(script);
  });
}
