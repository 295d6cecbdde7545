'use strict';
// The sections of report.html, in the order in which they are read. Each takes
// the page's data and returns nodes, or null where it has nothing to show.
(() => {
  const {html, number, isNumber, shortened, legend, table, bars, interval, skeleton, percent, note, list} = charts;
  const data = JSON.parse(document.getElementById('data').textContent);
  const result = data.result;
  charts.before = (data.skeleton || {}).before;

  // -- what it comes to ---------------------------------------------------------

  const verdicts = {
    calibrate: () => {
      const termination = result.termination || {};
      if (!result.verdict && termination.converged === false) {
        return {good: false, sentence: 'Not calibrated.', reasons: [termination.reason]};
      }
      const passed = !result.verdict || result.verdict.passed;
      const held = result.validation_stacked_residual_percent;
      const left = result.stacked_residual_percent;
      const poses = result.poses || {};
      const fit = !isNumber(left) ? isNumber(poses.rms) ? [`Measured poses are met to ` +
          `${number(1e3 * poses.rms)} mm rms; with the file’s geometry to ${number(1e3 * poses.before_rms)} mm.`]
          : [] : [`All but ${percent(left)} of the torque is explained` +
          (isNumber(held) ? `, and all but ${percent(held)} on motion it has not seen.` : '.')];
      return {good: passed,
              sentence: passed ? fit[0] || 'Calibrated.' : 'This calibration is worth nothing as it is.',
              reasons: passed ? [] : [...result.verdict.reasons, ...fit]};
    },
    verify: () => ({
      good: result.passed,
      sentence: (result.passed ? 'Simbody computes what armcal computes.'
                               : 'This robot did not pass.') + rolloutSentence(),
      reasons: result.reasons || []}),
    diagnose: () => ({
      good: ['explained', 'absorbed', 'noise_floor'].includes(result.verdict),
      sentence: result.sentence, reasons: []}),
    compare: () => ({
      good: result.agrees,
      sentence: result.sentence[0].toUpperCase() + result.sentence.slice(1) + '.',
      reasons: [...result.notes, ...firstOf(result.pairs.flatMap((pair) => pair.disagreements))]}),
    inspect: () => {
      const found = [result.robot, ...(result.logs || [])].flatMap((of) => of.findings);
      return {good: found.length === 0, reasons: found.map((f) => f.sentence),
              sentence: found.length === 0 ? 'Nothing wrong was found.'
                  : found.length === 1 ? 'One thing is wrong.' : `${found.length} things are wrong.`};
    },
    excite: () => ({
      good: result.designed !== false,
      sentence: result.designed === false ? 'No motion within the limits tells everything.'
          : isNumber(result.duration) ? `A motion of ${number(result.duration)} s within the limits.`
          : 'Postures to measure at.',
      reasons: []}),
  };

  // As many as are read; the sections have all of them.
  const firstOf = (sentences) => sentences.length <= 5 ? sentences
      : [...sentences.slice(0, 5), `and ${sentences.length - 5} more`];

  const rolloutSentence = () => {
    const last = (result.rollout || []).filter((r) => isNumber(r.ratio)).pop();
    return last ? ` Simulated for ${number(last.window_s)} s, the calibrated robot is off by ` +
        `${number(100 * last.ratio)} % of what the file’s is.` : '';
  };

  const header = () => {
    const {good, sentence, reasons} = verdicts[data.command]();
    const button = html('button', {type: 'button'}, 'light / dark');
    button.addEventListener('click', () => {
      setDark(!document.documentElement.classList.contains('dark'));
      plots.redraw();
    });
    return html('header', {}, [
      html('a', {class: 'skip', href: '#section-0'}, 'Skip the list of sections'),
      html('div', {class: 'top'},
           [html('span', {class: 'faint'}, `armcal ${data.command} · ${shortened(data.robot, 60)}`), button]),
      html('div', {class: 'verdict ' + (good ? 'good' : 'bad')}, [
        html('h1', {}, (good ? '✓ ' : '✗ ') + sentence),
        reasons.length ? list(reasons) : null])]);
  };

  // -- verification --------------------------------------------------------------

  const checkNames = {
    torque_max_rel: 'torque', mass_matrix_max_rel: 'mass matrix', gravity_max_rel: 'gravity torque',
    energy_max_rel: 'energy', log_torque_max_rel: 'torque along the logs', energy_drift_rel: 'energy drift of Simbody’s simulation',
    own_energy_drift_rel: 'energy drift of ours', own_consistency_rel: 'forward, then inverse dynamics'};
  const checks = () => data.command === 'verify' && table(
      ['check', 'largest (relative) difference', 'at most', ''],
      (result.checks || []).map((c) => [checkNames[c.name] || c.name.replace(/_/g, ' ')
          .replace('rollout ratio low', 'error of the simulation over the file’s, low end of its interval,'), c.value, c.threshold,
                                        c.passed === null ? 'not compared' : c.passed ? '✓' : '✗ failed']));
  const rollouts = () => (result.rollout || []).length > 0 && result.rollout.flatMap((r) => [
    html('h3', {}, `${number(r.window_s)} s from the log’s states, rms of positions in ${r.unit}`),
    bars([{label: 'the file’s robot', value: r.before_rms, colour: 'c2',
           low: (r.before_ci95 || [])[0], high: (r.before_ci95 || [])[1]},
          {label: 'calibrated', value: r.after_rms, colour: 'c1',
           low: (r.ci95 || [])[0], high: (r.ci95 || [])[1]}], r.unit),
    note(`median of ${r.windows} windows with its 95 % interval, ` +
         `${(r.in_simbody || {}).windows || 0} of them simulated by Simbody` +
         (isNumber(r.ratio) ? `; the ratio is ${number(r.ratio)}` : ''))]);

  const logTorques = () => result.log_torques && table(
      ['joint', 'the file’s robot', 'calibrated', 'recorded', 'unit'],
      result.log_torques.joints.map((j) => [j.name, number(j.before_rms), number(j.after_rms), number(j.recorded_rms), j.unit]), true);

  // -- design --------------------------------------------------------------------

  const motionGroup = plots.group();
  const motion = () => {
    const m = data.extra.motion;
    return m && [legend(['position', 'velocity']), ...m.joints.map((joint, j) => plots.add(
        `${shortened(joint.name, 60)}, ${joint.unit} and ${joint.unit}/s`,
        () => m.t.map((t, k) => [t, m.q[j][k], m.qd[j][k]]), ['s', 'position', 'velocity'], {}, motionGroup)),
      table(['joint', 'from', 'to', 'velocity up to', 'acceleration up to'],
            (result.joints || []).map((l) => [l.name, l.lower, l.upper, l.velocity, l.acceleration]))];
  };
  const predicted = () => data.command === 'excite' && (result.parameters || []).length > 0 && table(
      ['quantity', 'predicted standard deviation', result.parameters.some((p) => isNumber(p.given_stddev))
          ? 'known before' : data.extra.postures ? 'with random postures' : 'with a random motion', 'unit'],
      result.parameters.map((p) => [p.name, number(p.stddev),
        isNumber(p.given_stddev) ? number(p.given_stddev)
            : isNumber(p.random_stddev) ? number(p.random_stddev) : '–', p.unit]), true);
  const assumed = () => (result.assumed || []).length > 0 && list(result.assumed);
  const postures = () => {
    const chains = data.extra.postures;
    return chains && [
      skeleton(chains.map((points, k) => ({points, colour: 'c' + (1 + k % 4), width: 3, opacity: .7})),
               data.skeleton.joints),
      note('The robot at every posture, names at the first. Drag, or use the arrow keys, to turn them.')];
  };

  // -- where it comes from -------------------------------------------------------

  const robot = () => {
    if (['diagnose', 'inspect'].includes(data.command) || !data.skeleton || data.extra.postures) return null;
    if ((data.extra.geometry || {}).skeleton) return null;
    const drawn = skeleton([{points: data.skeleton.points}], data.skeleton.joints);
    return drawn && [drawn, note('Joint axes of the robot file, at a bent posture. Drag, or use the arrow keys.')];
  };

  const provenance = () => {
    const p = data.provenance;
    return [
      html('p', {}, html('code', {}, p.arguments.join(' '))),
      p.files.length ? table(['file', 'bytes', 'SHA-256'], p.files.map((f) =>
          [f.path, String(f.bytes), html('code', {}, f.sha256)])) : null,
      note(Object.entries(p.versions).map(([name, v]) => `${name} ${v}`).join(', '))];
  };

  const {torques, positions, maps, spectra} = torqueSections(data);
  const {driveGains, jointTable, positionTable, geometry, poses, parameters, correlation, rank} = calibrationSections(data);
  const {changes} = changeSections(data);
  const {compared, comparedValues, comparedTorques} = comparisonSections(data);
  const {findings, robotDrawn, jointsRead, linksRead, notesRead, logsRead, coverage, drawn} = inspectionSections(data);
  const {poseEffects, poseGap, poseOrder, poseJoints, poseSpace, poseCorrection} = poseSections(data);
  const {dataFindings, effects, absorbed, gap, where, untestable} = diagnosisSections(data);
  const sections = [
    ['What is wrong', findings], ['The logs', logsRead], ['What the logs can tell', coverage],
    ['The robot, as it is read', robotDrawn], ['Its joints', jointsRead], ['Its links', linksRead],
    ['What was lumped, dropped or not used', notesRead], ['Positions, velocities and torques', drawn],
    ['What was compared', compared], ['Value by value', comparedValues], ['Torque left on the log', comparedTorques],
    ['The data', dataFindings], ['What changed from log to log', changes], ['Which effect', effects], ['What was only a wrong parameter', absorbed],
    ['How far the gap shrinks', gap], ['Where it lies', where],
    ['Which effect', poseEffects], ['How far the distances shrink', poseGap], ['In space', poseSpace],
    ['Pose by pose', poseOrder], ['Joint by joint', poseJoints], ['Corrections of joint positions', poseCorrection],
    ['Torque per current', driveGains], ['Joints', jointTable], ['Positions, in closed loop', positionTable], ['Checks', checks], ['Simulated from the log', rollouts],
    ['Torque that Simbody’s inverse dynamics leaves of the log, rms', logTorques],
    ['The motion', motion], ['The postures', postures], ['What it will tell', predicted], ['Assumed', assumed],
    ['Geometry', geometry], ['Pose by pose', poses],
    ['Following the command', positions], ['Torque, recorded and predicted', torques], ['What the residual follows', maps],
    ['Spectrum of what is left', spectra],
    ['Parameters', parameters], ['Correlations', correlation], ['What the logs show', rank],
    ['Not testable on these data', untestable], ['The robot', robot],
    ['Where this comes from', provenance]];

  const setDark = (dark) => document.documentElement.classList.toggle('dark', dark);

  // Paper is light, as wide as a page, and has everything on it.
  let wasDark = false;
  addEventListener('beforeprint', () => {
    wasDark = document.documentElement.classList.contains('dark');
    setDark(false);
    document.documentElement.classList.add('printed');
    plots.redraw();
    plots.print();
  });
  addEventListener('afterprint', () => {
    document.documentElement.classList.remove('printed');
    setDark(wasDark);
    plots.redraw();
  });

  setDark(matchMedia('(prefers-color-scheme: dark)').matches);
  document.title = `armcal ${data.command}: ${data.robot}`;
  const page = document.getElementById('page');
  page.append(header());
  const menu = html('nav', {'aria-label': 'sections'});
  page.append(menu);
  let shown = 0;
  for (const [title, make] of sections) {
    const nodes = [].concat(make() || []).filter((node) => node);
    if (nodes.length === 0) continue;
    const id = 'section-' + shown++;
    menu.append(html('a', {href: '#' + id}, title));
    page.append(html('section', {id, tabindex: -1}, [html('h2', {}, title), ...nodes]));
  }
  document.documentElement.dataset.ready = 'true';
})();
