'use strict';
// Of a calibration: joints, geometry, poses, parameters, correlations, rank.
const calibrationSections = (data) => {
  const {html, number, isNumber, legend, table, interval, beyond, correlations, strongest,
         skeleton, percent, plusMinus, note, heading, list} = charts;
  const result = data.result;

  const jointTable = () => data.command === 'calibrate' &&
      (result.joints || []).some((j) => isNumber(j.torque_rms)) && table(
      ['joint', 'torque rms', 'residual', 'held out', 'sample noise', 'friction turns over within'],
      result.joints.map((j) => [
        j.name, `${number(j.torque_rms)} ${j.unit}`,
        `${number(j.residual_rms)} ${j.unit} (${percent(j.residual_percent)})`,
        isNumber(j.validation_residual_percent) ? percent(j.validation_residual_percent) : '–',
        isNumber(j.sample_noise_stddev)
            ? `${number(j.sample_noise_stddev)} ${j.unit} (${j.noise_source})` : '–',
        j.coulomb_transition
            ? `${number(j.coulomb_transition.width)} ${j.coulomb_transition.unit}` : '–']));

  // rms, simulated minus measured.
  const positionTable = () => (result.joints || []).some((j) => isNumber(j.position_residual_rms)) && [table(
      ['joint', 'robot file', 'estimate', 'held out', 'encoder noise'],
      result.joints.map((j) => [j.name, ...[j.nominal_position_residual_rms, j.position_residual_rms,
        j.validation_position_residual_rms, j.encoder_noise_stddev].map(
            (x) => isNumber(x) ? `${number(x)} ${j.position_unit}` : '–')])),
    note('Root mean square of simulated minus measured positions.')];

  const driveGains = () => {
    if (!(result.drive_gains || []).length) return null;
    const load = result.payload || {}, axes = ['x', 'y', 'z'].map((axis) => isNumber(load['com_' + axis])
        ? `${axis} ${plusMinus(1e3 * load['com_' + axis], 1e3 * load[`com_${axis}_stddev`])} mm`
        : `${axis} not seen`);
    return [table(['joint', 'torque per current ± standard deviation', 'unit'], result.drive_gains.map((g) => [
              g.name, g.identifiable ? plusMinus(g.value, g.stddev) : g.reason || 'the data do not tell', g.unit])),
            result.drive_gains.some((g) => g.identifiable) && note(`From the known payload of ${number(load.mass)} kg; its centre of mass is found at ${axes.join(', ')}. ` +
                 'Torques below are currents times these values, which are taken for exact.')];
  };

  const parameterTable = (list) => {
    if (!list || list.length === 0) return null;
    const prior = list.some((p) => isNumber(p.prior));
    return table(
        ['parameter', 'value ± standard deviation', 'unit', '95 % interval', ...(prior ? ['file', ''] : [])],
        list.map((p) => [
          p.name, plusMinus(p.value, p.stddev), p.unit,
          p.identifiable === false ? html('span', {class: 'faint'}, 'the data do not tell')
              : isNumber(p.stddev) ? `${number(p.value - 1.96 * p.stddev)} to ${number(p.value + 1.96 * p.stddev)}`
              : '–',
          ...(prior ? [isNumber(p.prior) ? p.prior : '–',
                       p.identifiable === false ? '' : interval(p.value, p.stddev, p.prior)] : [])]), true);
  };

  const parameters = () => {
    if (data.command !== 'calibrate') return null;
    const physical = (result.parameters || []).filter((p) => isNumber(p.value));
    if (result.method === 'output_error') {
      return [note('The upright orange mark is the file.'), parameterTable(physical)];
    }
    if (!(result.model_parameters || []).length) return null;
    return [
      heading('Model parameters, which torques determine'),
      parameterTable(result.model_parameters),
      physical.length && result.estimate === 'refined'
          ? heading('The robot for a simulator; the upright orange mark is the file') : null,
      physical.length && result.estimate === 'refined' ? parameterTable(physical) : null];
  };

  const correlation = () => (data.extra.correlations || []).filter((c) => c.names.length > 1).flatMap((c) => {
    const pairs = strongest(c.names, c.values, .9, 12);
    return [heading(c.title), correlations(c.names, c.values),
            pairs.length ? html('p', {}, 'Hardly told apart (beyond 0.9): ' + pairs.map(([a, b, v]) =>
                `${a} and ${b} (${number(v)})`).join('; ') + '.')
                : html('p', {}, 'No two are correlated by more than 0.9.')];
  }).concat((data.extra.correlations || []).length
      ? [note('Orange: errors go together; blue: one grows as the other falls.')] : []);

  const rank = () => {
    const r = result.rank;
    if (!r) return null;
    const open = r.unidentifiable || [];
    return [
      html('p', {}, `${r.batch} of ${r.total} directions of the model are seen` +
           (open.length ? '; these are not:' : '.')),
      open.length ? html('ul', {}, open.map((d) => html('li', {}, typeof d === 'string' ? d
          : d.combination || JSON.stringify(d)))) : null,
      ...(r.advice || []).map((a) => html('p', {}, 'To see more: ' + (typeof a === 'string' ? a
          : `move ${(a.joints || []).join(' and ')}`))),
      ...(result.merged || []).map((text) => note(text))];
  };

  // Lengths in mm and angles in degrees.
  const read = (g) => g.unit === 'rad' ? [180 / Math.PI, '°'] : g.unit === 'm' ? [1e3, 'mm'] : [1, g.unit || ''];
  // Where the instrument sees the robot, of which the file says nothing.
  const placed = (g) => String(g.name).startsWith('base.');
  const geometryTable = () => table(
      ['parameter', 'file', 'calibrated ± standard deviation', 'change', 'unit'],
      result.geometry.map((g) => {
        const [scale, unit] = read(g), value = isNumber(g.used) ? g.used : g.value;
        const told = g.identifiable !== false && isNumber(value);
        return [g.symbol || g.name, isNumber(g.nominal) && !placed(g) ? scale * g.nominal : '–',
                told ? plusMinus(scale * value, scale * g.stddev) : 'the data do not tell',
                told && isNumber(g.nominal) && !placed(g) ? scale * (value - g.nominal) : '–', unit];
      }), true);
  // Sentences about one name each that say the same, as one.
  const alike = (sentences) => {
    const names = new Map();
    for (const sentence of sentences) {
      const space = sentence.indexOf(' '), rest = sentence.slice(space + 1);
      names.set(rest, [...(names.get(rest) || []), sentence.slice(0, space)]);
    }
    return [...names].map(([rest, of]) => `${of.join(', ')} ${rest}`);
  };
  // Deviations are enlarged by 1, 2 or 5 times a power of ten, to about an
  // eighth of the robot.
  const enlargement = (deviation, size) => {
    if (!(deviation > 0)) return 1;
    const wanted = size / 8 / deviation, power = Math.pow(10, Math.floor(Math.log10(wanted)));
    return Math.max(1, [5, 2, 1].map((k) => k * power).find((k) => k <= wanted));
  };
  const geometryPicture = () => {
    const after = ((data.extra.geometry || {}).skeleton || {}).points, before = data.skeleton.points;
    if (!after) return [];
    const difference = after.map((p, k) => p.map((x, i) => x - before[k][i]));
    const most = Math.max(...difference.map((d) => Math.hypot(...d)));
    const size = Math.max(...before.map((p) => Math.hypot(...p.map((x, i) => x - before[0][i]))));
    const times = enlargement(most, size);
    return [
      heading(`Joint axes and tool, deviations drawn ${number(times)} times as large`),
      html('div', {class: 'legend'}, [html('span', {class: 'key-file'}, 'the robot file'),
                                      html('span', {class: 'key-calibrated'}, 'calibrated')]),
      html('div', {class: 'beside'}, [
        skeleton([{points: before, colour: 'c2', width: 4, dash: '8 5'},
                  {points: before.map((p, k) => p.map((x, i) => x + times * difference[k][i])),
                   colour: 'c1', width: 4}], data.skeleton.joints),
        table(['point', 'moved by, mm'], difference.map((d, k) =>
            [data.skeleton.joints[k] || 'tool', 1e3 * Math.hypot(...d)]))])];
  };
  const geometry = () => (result.geometry || []).length > 0 && [
    ...geometryPicture(), geometryTable(),
    ...((result.held || []).length ? [heading('Kept as in the file'), list(alike(result.held))] : [])];

  const poses = () => {
    const p = (data.extra.geometry || {}).poses;
    if (!p) return null;
    return [
      html('div', {class: 'legend'}, [html('span', {style: 'color: var(--c2)'}, '□ the robot file'),
                                      html('span', {style: 'color: var(--c1)'}, '● calibrated')]),
      plots.dots('distance between measured and computed, mm',
                 p.after.map((d, k) => [k + 1, 1e3 * p.before[k], 1e3 * d]),
                 ['pose', 'the robot file', 'calibrated']),
      note('In the order of the file; where a pose shows several targets, one after the other. Hollow squares: ' +
           'the file’s geometry with only the instrument placed; dots: calibrated.' +
           (result.poses && (result.poses.outlier_rows || []).length
              ? ` Given up as wrong: rows ${result.poses.outlier_rows.slice(0, 20).join(', ')}.` : ''))];
  };

  return {driveGains, jointTable, positionTable, geometry, poses, parameters, correlation, rank};
};
