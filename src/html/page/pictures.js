// Pictures that the build drew.

function picture_title(name) {
  if (name === 'rest') return 'Rest pose';
  if (name === 'weights') return 'Each vertex in the colour of its strongest joint';
  if (name.startsWith('junction')) return `Junction of operation ${name.slice(8)}`;
  return name.startsWith('clip_') ? `Clip ${name.slice(5)}` : name;
}

function pictures_section(pictures) {
  const figures = pictures.map(({ name, source }) => make('figure', null,
    make('img', { src: source, alt: picture_title(name), loading: 'lazy' }),
    make('figcaption', null, picture_title(name))));
  return section('pictures', 'Pictures', figures.length ? make('div', { class: 'figures' }, figures) : null);
}
