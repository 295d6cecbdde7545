'use strict';
// Of an inspection: what is wrong, what was read of the robot, what logs hold.
const inspectionSections = (data) => {
  const {html, number, isNumber, shortened, legend, table, skeleton, percent, note, heading, list} = charts;
  const inspects = data.command === 'inspect', result = data.result;
  const robot = result.robot || {}, logs = inspects ? result.logs || [] : [];
  // What is 0 but for rounding is 0.
  const vector = (v) => v ? v.map((x) => number(Math.abs(x) < 1e-9 ? 0 : x)).join(', ') : '–';
  const shown = (x) => isNumber(x) ? x : '–';

  const findingsOf = (name, findings) => !(findings || []).length ? [] : [
    heading(shortened(name, 90)),
    table(['what is wrong', 'what says so', 'what mends it'], findings.map((f) => [
      f.sentence + (f.probability < .995 ? ` (probability ${number(f.probability)})` : ''), f.evidence, f.flag]))];
  const findings = () => inspects &&
      [...findingsOf('the robot file', robot.findings), ...logs.flatMap((log) => findingsOf(log.file, log.findings))];

  // Axes are drawn as long as a seventh of the robot is.
  const axisLines = () => {
    const points = data.skeleton.points, first = points[0];
    const size = Math.max(...points.map((p) => Math.hypot(...p.map((x, k) => x - first[k]))));
    return robot.joints.map((joint, j) => ({colour: 'c2', width: 3, points: [-1, 1].map((side) =>
        points[j].map((x, k) => x + side * size / 14 * joint.axis[k]))}));
  };
  const robotDrawn = () => {
    if (!inspects || !data.skeleton) return null;
    const chain = {points: data.skeleton.points, width: 6};
    const drawn = skeleton([chain, ...axisLines()], data.skeleton.joints);
    return drawn && [drawn, note('All joints at zero; orange lines are the joints’ axes. Drag, or use the arrow keys, to turn it.')];
  };

  const kinds = {revolute: 'rad', continuous: 'rad', prismatic: 'm'};
  const jointsRead = () => inspects && [
    table(['joint', 'type', 'axis in the base’s frame', 'from', 'to', 'velocity up to', 'effort up to', 'viscous',
           'Coulomb', 'armature', 'offset'], robot.joints.map((j) => [
      j.name, j.type, vector(j.axis), shown(j.lower), shown(j.upper), shown(j.velocity), shown(j.effort),
      shown(j.viscous), shown(j.coulomb), shown(j.armature), shown(j.offset)])),
    note('SI units: rad, rad/s and N m of joints that turn, m, m/s and N of those that slide. – is what the file does not give or limit.')];
  const linksRead = () => inspects && [
    table(['link', 'sits on', 'mass, kg', 'centre of mass in its frame, m'], robot.links.map((l) => [
      l.name, l.parent || 'the base', shown(l.mass), vector(l.com)])),
    note(`Gravity ${vector(robot.gravity)} m/s² in the base’s frame` + (robot.tool ? `; tool ${robot.tool}.` : '.'))];
  const notesRead = () => inspects && (robot.notes || []).length > 0 && list(robot.notes);

  // -- logs ----------------------------------------------------------------------

  const logTable = () => logs.length > 0 && table(
      ['log', 'rows', 's', 'step, ms', 'longest, ms', 'missing', 'in motion', 'torque', 'best fit leaves'],
      logs.map((l) => [
        shortened(l.file, 60), l.rows + (l.whole ? '' : ' (the first ones)'), l.duration, 1e3 * l.step,
        1e3 * l.longest_step, percent(100 * l.lost_share), percent(100 * l.moving_share), l.torque || 'none',
        l.residual_percent > 0 ? percent(l.residual_percent) : '–']));
  const travelled = () => logs.flatMap((log) => !log.joints.length ? [] : [
    heading(shortened(log.file, 90)),
    table(['joint', 'travels', 'up to, per s', 'torque over the file’s (95 %)', ...(isNumber(log.joints[0].tracking_rms) ? ['rms off its command'] : [])],
          log.joints.map((j, k) => [j.name, `${number(j.travel)} ${kinds[robot.joints[k].type] || ''}`, j.top_speed,
                                    j.torque_scale ? `${number(j.torque_scale.value)} (${number(j.torque_scale.low)} to ${number(j.torque_scale.high)})` : '–',
                                    ...(isNumber(j.tracking_rms) ? [j.tracking_rms] : [])]))]);
  const logsRead = () => logs.length > 0 && [logTable(), ...travelled()];

  const coverage = () => logs.flatMap((log) => {
    const c = log.coverage || {};
    if (!c.known && !c.reason) return [];
    const told = c.known ? [
      html('p', {}, `${c.rank} of ${c.total} directions of the model parameters show` +
           (c.unseen.length ? '; these do not:' : '.')),
      c.unseen.length ? list(c.unseen) : null,
      c.advice ? html('p', {}, `To see more: ${c.advice}.`) : null,
      note(`Calibrated on it, the model leaves ${percent(c.residual_percent)}; noise is told from ${c.noise_source}.`)]
        : [html('p', {}, `Nothing yet: ${c.reason}.`)];
    return [heading(shortened(log.file, 90)), ...told];
  });

  const {perLog, rows} = torqueSections(data);
  const drawn = () => {
    const plotted = perLog(data.extra.signals || [], (trace) => {
      const together = plots.group();
      const plot = (of, j, unit, labels, kind) => of && plots.add(
          `${shortened(of.joints[j].name, 60)}, ${labels.join(' and ')}, ${unit}`,
          () => rows(of.t, of.joints[j], 0, labels.length), ['s', ...labels], {customBars: true}, together, kind);
      const ofPosition = ['position', ...trace.position.labels];
      return [legend(ofPosition), ...trace.position.joints.flatMap((joint, j) => [
        plot(trace.position, j, joint.position_unit, ofPosition, ''),
        plot(trace.velocity, j, joint.position_unit + '/s', ['velocity'], 'low'),
        plot(trace.torque, j, joint.unit, ['torque'], 'low')].filter((node) => node))];
    });
    return plotted && [...plotted, html('p', {class: 'faint screen'},
        'As logged, in SI units. Drag to zoom all of them, double click for all; arrows read values. Where a log ' +
        'has more samples than fit, a band holds the least and the largest of them.')];
  };

  return {findings, robotDrawn, jointsRead, linksRead, notesRead, logsRead, coverage, drawn};
};
