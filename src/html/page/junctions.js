// The surfaces that are new.

const share_text = (spread, key, digits = 2) => (spread ? spread[key].toFixed(digits) : '–');

function junctions_section(report) {
  const columns = [
    ['Operation', (j) => `${j.operation}: ${operation_text(report.operations[j.operation - 1])}`],
    ['Made as', (j) => make('span', { title: j.reason || null }, j.rung)],
    ['Faces', (j) => grouped(j.faces), 'number'],
    ['Quads', (j) => percent_text(j.faces ? j.quads / j.faces : 0, 0), 'number'],
    ['Borders', (j) => j.border_loops.join(', '), 'number'],
    ['Shape (5 %, mean)', (j) => `${share_text(j.scaled_jacobian, 'p05')}, ${share_text(j.scaled_jacobian, 'mean')}`, 'number'],
    ['Angle at the border (95 %)', (j) => (j.border_dihedral ? `${share_text(j.border_dihedral, 'p95', 1)}°` : '–'), 'number'],
    ['Colour step (95 %)', (j) => (j.border_color_step ? short_number(j.border_color_step.p95) : '–'), 'number'],
    ['Faults', (j) => {
      const faults = [['open edge', j.boundary_edges], ['non-manifold edge', j.non_manifold_edges],
        ['flat face', j.degenerate_faces], ['fold', j.folded_faces], ['crossing', j.self_intersections]];
      return faults.filter(([, n]) => n).map(([what, n]) => count_text(n, what)).join(', ') || 'none';
    }],
    ['Symmetric', (j) => (j.symmetry ? (j.symmetry.faces_symmetric ? 'yes' : j.symmetry.reason || 'no') : '–')],
  ];
  return section('junctions', 'Junctions', report.junctions.length ? table(columns, report.junctions) : null);
}
