'use strict';
// Of a diagnosis of measured poses: its effects, how far the distances shrink,
// and where they are: over the order of the poses, over each joint, in space.
const poseSections = (data) => {
  const {html, number, isNumber, table, bars, skeleton, percent, note, heading, legend} = charts;
  const result = data.result;
  const told = data.extra.pose_errors;
  const is = String(result.format).startsWith('armcal pose diagnosis') && result.gap;
  const mm = (x) => isNumber(x) ? 1e3 * x : null;
  const names = ['the geometry alone', 'with the effects'];

  const amount = (a) => {
    const scale = a.unit === '1' || a.unit === 'rad/rad' ? 1 : 1e3;
    const unit = scale === 1 ? '' : a.unit === 'm' ? ' mm' : ' m' + a.unit;
    const half = isNumber(a.ci95[1]) ? ` ± ${number(scale * (a.ci95[1] - a.ci95[0]) / 2)}` : ' ± ?';
    return `${a.name} ${number(scale * a.value)}${half}${unit}`;
  };
  const poseEffects = () => {
    if (!is) return null;
    const found = result.effects;
    if (!found.length) return html('p', {}, 'No effect is claimed.');
    return [
      bars(found.flatMap((e) => [e, ...e.equivalent.map((q) => ({...q, rival: true}))].map((c) => ({
        label: (c.rival ? 'or ' : '') + c.name, value: 100 * c.probability,
        colour: c.rival ? 'c1' : 'c2', note: Math.round(100 * c.probability) + ' %'}))), '%', {top: 100}),
      table(['effect', 'what it is', 'amounts with 95 % intervals', 'moves (rms, mm)', 'removes of held-out poses'],
            found.map((e) => [e.name, e.means, e.estimates.slice(0, 6).map(amount).join(', ') +
                              (e.estimates.length > 6 ? ', …' : ''), mm(e.displacement.rms),
                              percent(e.removed_percent)])),
      ...found.filter((e) => e.equivalent.length).map((e) => note(
          `To tell ${e.name} from the others: ` + (e.equivalent[0].told_apart_at.length
              ? `a pose at ${e.equivalent[0].told_apart_at.map((x) => x.toFixed(2)).join(', ')}, where the first ` +
                `two differ by ${number(mm(e.equivalent[0].differ))} mm.` : e.separate_by + '.')))];
  };

  const poseGap = () => {
    if (!is) return null;
    const g = result.gap.position, held = g.held_out, left = result.left;
    const row = (label, value, colour) => ({label, value: mm(value), colour});
    const any = result.effects.length > 0;
    return [
      heading('Distances, rms'),
      bars([row('frame alone', g.frame, 'c0'), row(names[0], g.geometry, 'c1'),
            ...(any ? [row(names[1], g.after, 'c3')] : [])], 'mm', {log: true}),
      heading('Of every sixth pose, left out in turn'),
      bars([row(names[0], held.interleaved.geometry, 'c1'),
            ...(any ? [row(names[1], held.interleaved.after, 'c3')] : [])], 'mm', {log: true}),
      note(`Left is ${number(mm(left.coordinate_rms))} mm rms of a coordinate` +
           (isNumber(left.instrument_ratio) ? `, ${number(left.instrument_ratio)} times the instrument's standard deviation.`
                                            : '; the file states no uncertainty of the instrument (u95).') +
           (left.outlier_rows.length ? ` Rows ${left.outlier_rows.slice(0, 20).join(', ')} fit badly.` : ''))];
  };

  const dots = (title, axis, x) => plots.dots(
      title, x.map((at, k) => [at, ...told.lengths[k].map(mm)]).sort((a, b) => a[0] - b[0]), [axis, ...names]);
  const poseOrder = () => is && told && [
    legend(names), dots('distance between measured and computed, mm', told.word, told.number),
    note('Hollow squares: the geometry alone; dots: with the effects. What changes at one pose, or little by little, ' +
         'is of the order; what does not is of the posture.')];
  const poseJoints = () => is && told && told.joints.map((joint, j) => dots(
      `the same over ${joint.name}, mm`, joint.unit, told.q[j]));

  const enlargement = (errors, reach) => {
    const rms = Math.sqrt(errors.reduce((sum, e) => sum + e.reduce((s, x) => s + x * x, 0), 0) / errors.length);
    const wanted = reach / 12 / Math.max(rms, 1e-12), power = Math.pow(10, Math.floor(Math.log10(wanted)));
    return Math.max(1, [5, 2, 1].map((k) => k * power).find((k) => k <= wanted));
  };
  const poseSpace = () => {
    if (!is || !told || !told.at) return null;
    const extent = [0, 1, 2].map((k) => Math.max(...told.at.map((p) => p[k])) - Math.min(...told.at.map((p) => p[k])));
    const times = enlargement(told.geometry, Math.hypot(...extent));
    const arrows = (errors, colour) => told.at.map((p, k) => (
        {points: [p, p.map((x, i) => x + times * errors[k][i])], colour, width: 2}));
    const figure = (errors, colour, title) => html('figure', {}, [
      skeleton([{points: told.posture, colour: 'line', width: 5}, ...arrows(errors, colour)], told.joints.map((j) => j.name)),
      html('figcaption', {class: 'faint'}, title)]);
    return [
      html('div', {class: 'beside'}, [figure(told.geometry, 'c1', names[0]),
                                      ...(result.effects.length ? [figure(told.after, 'c3', names[1])] : [])]),
      note(`From where a target was measured to where the model has it, ${number(times)} times as long; the robot at ` +
           'the first of the poses. Drag, or use the arrow keys, to turn it.' +
           (told.thinned > 1 ? ` One in ${told.thinned} of the targets is drawn.` : ''))];
  };

  const poseCorrection = () => {
    const c = result.correction;
    if (!is || !c) return null;
    // Less than equations are solved to is not shown.
    const size = (x) => x < 1e-6 ? 'below 0.001' : mm(x);
    const row = (label, e) => [label, size(e.median), size(e.p95), size(e.most)];
    return [
      table(['the tool in 1000 postures, mm away', 'median', '95 %', 'at most'],
            [row('as commanded', c.before), row('with correction.c', c.command),
             row('with correction.csv', c.table.command)]),
      c.validation ? html('p', {}, `${c.validation.poses} poses that were held out: ${number(mm(c.validation.before))} ` +
          `mm rms by the robot file, ${number(mm(c.validation.after))} by what was found.`) : null,
      c.left_out.length ? note('Not part of it, since it is none of the arm’s: ' + c.left_out.join('; ') + '.') : null];
  };

  return {poseEffects, poseGap, poseOrder, poseJoints, poseSpace, poseCorrection};
};
