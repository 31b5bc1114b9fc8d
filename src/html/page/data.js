// What the build put into the page.

function json_data(id) {
  const element = document.getElementById(id);
  return element ? JSON.parse(element.textContent) : null;
}

function file_data(id) {
  const element = document.getElementById(id);
  if (!element) return null;
  const text = atob(element.textContent);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes.buffer;
}

// The module of the 3D view; null where the program that wrote the page had none.
async function viewer_module() {
  const packed = file_data('viewer');
  if (!packed) return null;
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'));
  const source = await new Response(stream).blob();
  const address = URL.createObjectURL(new Blob([source], { type: 'text/javascript' }));
  return import(address).finally(() => URL.revokeObjectURL(address));
}
