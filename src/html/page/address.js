// What the address asks to show behind its #, so that a line in a review can point at a frame:
// #clip=Gallop&time=0.3&colors=source&joint=Spine&wire&skeleton&play

function follow_address({ player, colors, switches, paints }) {
  const wanted = new URLSearchParams(location.hash.slice(1));
  const color = wanted.get('colors');
  if (color && paints[color]) colors.choose(color);
  if (wanted.has('joint') && color === 'weight') paints.weight.pick(wanted.get('joint'));
  for (const name of ['wire', 'skeleton']) if (wanted.has(name)) switches[name].set(true);
  if (wanted.has('clip')) player.choose(wanted.get('clip'), Number(wanted.get('time') ?? 0));
  if (wanted.has('play')) player.play();
}
