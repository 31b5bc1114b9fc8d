// Numbers as people read them.

const grouped = (n) => String(Math.round(n)).replace(/\B(?=(\d{3})+(?!\d))/g, '\u202f');

function size_text(bytes) {
  if (bytes < 1000) return `${bytes} B`;
  return bytes < 1e6 ? `${Math.round(bytes / 1000)} kB` : `${(bytes / 1e6).toFixed(bytes < 1e7 ? 2 : 1)} MB`;
}

function seconds_text(seconds) {
  if (seconds < 0.001) return '< 1 ms';
  if (seconds < 0.0995) return `${Math.round(seconds * 1000)} ms`;
  return seconds < 100 ? `${seconds.toFixed(seconds < 10 ? 2 : 1)} s` : `${Math.round(seconds / 60)} min`;
}

const percent_text = (share, digits = 1) => `${(100 * share).toFixed(digits)} %`;

// With three digits that count; what is next to nothing is 0.
const short_number = (n) => (Math.abs(n) < 5e-5 ? '0' : Math.abs(n) >= 1000 ? grouped(n) : String(Number(n.toPrecision(3))));

const count_text = (n, one, many = `${one}s`) => `${grouped(n)} ${n === 1 ? one : many}`;
