// SPDX-License-Identifier: MIT
// Unpacks the page's blobs (gzip in base64) on first use, and keeps the result.
const unpacked = new Map();

function once(key, make) {
  if (!unpacked.has(key)) {
    unpacked.set(key, make());
  }
  return unpacked.get(key);
}

async function bytesOf(name) {
  const text = atob(document.getElementById("blob-" + name).textContent);
  const packed = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) {
    packed[i] = text.charCodeAt(i);
  }
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

async function textOf(name) {
  return new TextDecoder().decode(await bytesOf(name));
}

/** Returns a value of the page's data. */
function jsonOf(name) {
  return once(name, async () => JSON.parse(await textOf(name)));
}

/** Returns an array of a scene: Float32Array or Uint32Array. */
async function arrayOf(name, Type) {
  return new Type((await bytesOf(name)).buffer);
}

/** Runs a library's text as a script of the page. */
function libraryOf(name) {
  return once(name, async () => {
    const script = document.createElement("script");
    script.textContent = await textOf(name);
    document.head.append(script);
  });
}
