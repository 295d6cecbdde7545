'use strict';
// Recorded and predicted torques: over time, what the difference follows, its
// spectrum; measured and simulated positions. Each section is a function that
// gives nodes, or null.
const torqueSections = (data) => {
  const {html, number, shortened, legend, profile, note, heading} = charts;
  const result = data.result;

  // Columns of dygraphs with a low, a middle and a high value per signal.
  const rows = (t, joint, begin, end) => t.map((time, k) => [time].concat(
      joint.low.slice(begin, end).map((low, s) => {
        const high = joint.high[begin + s][k];
        return low[k] === null ? [null, null, null] : [low[k], (low[k] + high) / 2, high];
      })));

  // What make() draws of one log, and a choice of the log where there are many.
  const perLog = (traces, make) => {
    if (traces.length === 0) return null;
    const place = html('div', {class: 'plots'});
    const show = (k) => {
      plots.forget(place);
      place.replaceChildren(...make(traces[k]));
    };
    show(0);
    if (traces.length === 1) return [note(traces[0].log), place];
    const choice = html('select', {}, traces.map((trace, k) =>
        html('option', {value: k}, shortened(trace.log, 90))));
    choice.addEventListener('change', () => show(Number(choice.value)));
    return [html('label', {class: 'choice'}, ['Log ', choice]), traces[0].logs > traces.length
        ? note(`The first ${traces.length} of ${traces[0].logs} logs are drawn.`) : null, place];
  };

  const heldOut = data.command === 'diagnose'
      ? ' Only what the model shown was not fitted to is drawn.' : '';
  // What was recorded and what models say, and below it the difference.
  const traced = (traces, words) => {
    const drawn = perLog(traces, (trace) => {
      const labels = [words.recorded, ...trace.labels], together = plots.group();
      return [legend(labels), ...trace.joints.flatMap((joint) => [
        plots.add(`${shortened(joint.name, 60)}${words.what}, ${joint[words.unit]}`,
                  () => rows(trace.t, joint, 0, labels.length), ['s', ...labels],
                  {customBars: true}, together),
        plots.add(`${shortened(joint.name, 60)}, ${words.difference}, ${joint[words.unit]}`,
                  () => rows(trace.t, joint, labels.length, 2 * labels.length - 1),
                  ['s', ...trace.labels], {customBars: true}, together, 'low')])];
    });
    return drawn && [...drawn, html('p', {class: 'faint screen'},
        'Drag to zoom all of them, shift and drag to move, double click for all. With the keyboard: arrows ' +
        'read values, + and − zoom, shift and arrows move, Home shows all. Where a log has more samples ' +
        'than fit, a band holds the least and the largest of them.' + heldOut)];
  };
  const torques = () => traced(data.torques, {
    recorded: 'recorded', what: '', difference: 'recorded minus predicted', unit: 'unit'});
  const positions = () => {
    const drawn = traced(data.extra.positions || [], {
      recorded: 'measured', what: ' minus its command', difference: 'measured minus simulated',
      unit: 'position_unit'});
    return drawn && [note('The arm and its drives simulated in closed loop along the command, in windows ' +
        'of a few seconds, whose first second is left out.'), ...drawn];
  };

  const densities = (trace, j) => trace.spectrum.f.slice(1).map(
      (x, k) => [x].concat(trace.spectrum.density.map((m) => Math.sqrt(m[j][k + 1]))));
  const spectra = () => {
    const drawn = perLog(data.torques.filter((trace) => trace.spectrum), (trace) => {
      const together = plots.group();
      return [legend(trace.labels), ...trace.joints.map((joint, j) => plots.add(
          `${shortened(joint.name, 60)}, ${joint.unit}/√Hz`, () => densities(trace, j),
          ['Hz', ...trace.labels], {logscale: true}, together))];
    });
    return drawn && [...drawn, note('Of recorded minus predicted torque. Flat is noise; a peak is a vibration; ' +
        'what is high at low frequencies is motion that the model does not have. Torques were low-passed, ' +
        'which makes the fall at the right end.')];
  };

  // -- where it lies -------------------------------------------------------------

  // The noise of joint j's torque, if it is known.
  const floorOf = (j) => data.command === 'diagnose' && result.where
      ? result.where.joints[j].floor_rms : ((result.joints || [])[j] || {}).sample_noise_stddev;
  const coordinates = (joint) => [
    ['position', joint.position_unit], ['velocity', joint.position_unit + '/s'],
    ['load', joint.unit], ['time', 's']];
  const maps = () => {
    const drawn = perLog(data.torques, (trace) => [
      legend(trace.labels), ...trace.joints.map((joint, j) => {
        const floor = floorOf(j), kinds = coordinates(joint).filter(([kind]) =>
            joint.where[kind].mean.length > 0 && joint.where[kind].mean[0].length > 0);
        const means = kinds.flatMap(([kind]) => joint.where[kind].mean.flat()).map((v) => Math.abs(v || 0));
        const reach = Math.max(1.5 * (floor || 0), ...means, 1e-9);
        return kinds.length === 0 ? heading(`${shortened(joint.name, 60)} does not move here.`)
            : html('div', {class: 'unbroken'}, [
              heading(`${shortened(joint.name, 60)}, from −${number(reach)} to ${number(reach)} ${joint.unit}` +
                      (floor > 0 ? `; noise ${number(floor)} ${joint.unit}` : '')),
              html('div', {class: 'panels'}, kinds.map(([kind, unit]) =>
                  profile(kind, unit, joint.where[kind], trace.labels, reach, floor)))]);
      })]);
    const floored = data.torques.some((trace) => trace.joints.some((_, j) => floorOf(j) > 0));
    return drawn && [...drawn, note('Means of recorded minus predicted torque over what the joint does (load: the ' +
        'torque predicted). A slope over velocity is viscous friction, a step at zero dry friction, a wave over ' +
        'position a gear or gravity, a slope over load a wrong gain, a drift over time warming. ' + (floored
          ? 'The grey band is the noise of one sample. Strips, one per line of the legend: the darker, the larger ' +
            'the rms; clear at the noise, full at ten times the noise. ' : '') +
        'Over frequency: see the spectrum.' + heldOut)];
  };

  return {torques, positions, maps, spectra, perLog, rows};
};
