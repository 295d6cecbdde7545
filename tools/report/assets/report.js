'use strict';
// The sections of report.html, in the order in which they are read. Each takes
// the page's data and returns nodes, or null where it has nothing to show.
(() => {
  const {html, number, isNumber, shortened, legend, table, bars, interval, beyond, profile,
         correlations, strongest, skeleton} = charts;
  const data = JSON.parse(document.getElementById('data').textContent);
  const result = data.result;

  const percent = (x) => isNumber(x) ? number(x) + ' %' : '–';
  const plusMinus = (value, stddev) =>
      isNumber(stddev) ? `${number(value)} ± ${number(stddev)}` : number(value);
  const note = (text) => html('p', {class: 'faint'}, text);
  const heading = (text) => html('h3', {}, text);
  const list = (items) => html('ul', {}, items.map((item) => html('li', {}, item)));

  // -- what it comes to ---------------------------------------------------------

  const verdicts = {
    calibrate: () => {
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
      good: result.verdict === 'explained' || result.verdict === 'noise_floor',
      sentence: result.sentence, reasons: []}),
    excite: () => ({
      good: result.designed !== false,
      sentence: result.designed === false ? 'No motion within the limits tells everything.'
          : isNumber(result.duration) ? `A motion of ${number(result.duration)} s within the limits.`
          : 'Postures to measure at.',
      reasons: []}),
  };

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

  // -- torques over time ---------------------------------------------------------

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
      ? ' Only stretches that nothing was fitted to are drawn.' : '';
  const torques = () => {
    const drawn = perLog(data.torques, (trace) => {
      const labels = ['recorded', ...trace.labels], together = plots.group();
      return [legend(labels), ...trace.joints.flatMap((joint) => [
        plots.add(`${shortened(joint.name, 60)}, ${joint.unit}`,
                  () => rows(trace.t, joint, 0, labels.length), ['s', ...labels],
                  {customBars: true}, together),
        plots.add(`${shortened(joint.name, 60)}, recorded minus predicted, ${joint.unit}`,
                  () => rows(trace.t, joint, labels.length, 2 * labels.length - 1),
                  ['s', ...trace.labels], {customBars: true}, together, 'low')])];
    });
    return drawn && [...drawn, html('p', {class: 'faint screen'},
        'Drag to zoom all of them, shift and drag to move, double click for all. With the keyboard: arrows ' +
        'read values, + and − zoom, shift and arrows move, Home shows all. Where a log has more samples ' +
        'than fit, a band holds the least and the largest of them.' + heldOut)];
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

  // -- calibration ---------------------------------------------------------------

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
    const distances = [...p.before, ...p.after].filter((d) => d > 0).map((d) => 1e3 * d);
    return [
      html('div', {class: 'legend'}, [html('span', {style: 'color: var(--c2)'}, '□ the robot file'),
                                      html('span', {style: 'color: var(--c1)'}, '● calibrated')]),
      plots.add('distance between measured and computed, mm',
                () => p.after.map((d, k) => [k + 1, 1e3 * p.before[k], 1e3 * d]),
                ['pose', 'the robot file', 'calibrated'],
                {logscale: true, strokeWidth: 0, drawPoints: true, pointSize: 3,
                 valueRange: [Math.min(...distances) / 2, 2 * Math.max(...distances)],
                 drawPointCallback: (g, name, pen, x, y, colour, size) => {
                   pen.beginPath();
                   pen.setLineDash([]);
                   pen.lineWidth = 1.5;
                   pen.strokeStyle = pen.fillStyle = colour;
                   if (name === 'calibrated') pen.arc(x, y, size, 0, 2 * Math.PI), pen.fill();
                   else pen.rect(x - size, y - size, 2 * size, 2 * size), pen.stroke();
                 }}),
      note('In the order of the file; where a pose shows several targets, one after the other. Hollow squares: ' +
           'the file’s geometry with only the instrument placed; dots: calibrated.' +
           (result.poses && (result.poses.outlier_rows || []).length
              ? ` Given up as wrong: rows ${result.poses.outlier_rows.slice(0, 20).join(', ')}.` : ''))];
  };

  // -- diagnosis -----------------------------------------------------------------

  const testable = result.verdict !== 'not_testable';
  const whole = (interval) => (interval || []).length === 2 && interval.every(isNumber);
  const effects = () => {
    if (data.command !== 'diagnose' || !testable) return null;
    const candidates = result.candidates || [];
    const found = result.effects || [];
    const name = (c) => String(c.effect).replace(/_/g, ' ') +
        (c.joint ? ' on ' + c.joint : jointName(c.joint_index));
    const chart = bars(candidates.slice(0, 12).map((c) => ({
      label: name(c), value: 100 * c.probability, colour: c.probability >= .8 ? 'c2' : 'c1',
      note: c.probability < .005 ? 'less than 1 %' : Math.round(100 * c.probability) + ' %'})), '%', {top: 100});
    return [
      chart ? heading('How likely each is') : null,
      chart || html('p', {}, 'No effect is claimed.'),
      found.length ? table(['effect', 'size', 'removes of the gap', 'cannot be told from'],
        found.map((e) => [
          name(e),
          (e.estimates || []).map((s) => `${s.name} ${plusMinus(s.value, s.stddev)} ${s.unit}`).join(', '),
          isNumber(e.removed_percent)
              ? percent(e.removed_percent) + (whole(e.ci95) ? ` [${e.ci95.map(number).join(', ')}]` : '') : '–',
          (e.equivalent || []).map((q) => typeof q === 'string' ? q : name(q)).join(', ') || '–'])) : null,
      found.some((e) => isNumber(e.removed_percent)) ? note('Of the gap that fitting again leaves, on motion that ' +
          'nothing was fitted to' + (found.some((e) => whole(e.ci95)) ? '; in brackets its 95 % interval.' : '.')) : null,
      ...found.filter((e) => e.separate_by).map((e) => note(`To tell ${name(e)} from the others: ${e.separate_by}.`))];
  };
  const jointName = (index) => index > 0 && result.where && result.where.joints[index - 1]
      ? ' on ' + result.where.joints[index - 1].name : '';

  const absorbed = () => testable && (result.absorbed || []).length > 0 && [
    table(['parameter', 'model as it was', 'fitted ± standard deviation', 'unit', 'in its standard deviations'],
          result.absorbed.map((p) => [p.name, p.nominal, plusMinus(p.value, p.stddev), p.unit,
                                      p.prior_deviations])),
    note('Far from where the file, or the reference, has them: these explain torque without any effect. The last ' +
         'column is by how many standard deviations of what was believed before.')];

  const gap = () => {
    if (!result.gap) return null;
    const left = (g, removed) => g.refit - (g.refit - g.floor) * removed / 100;
    const part = (title, g) => g && isNumber(g.refit) ? [
      heading(title),
      bars([['model as it is', g.nominal, 'c2'], ['fitted again', g.refit, 'c1'],
            ['with the effects', (result.effects || []).length ? g.after : null, 'c3'],
            ['noise', g.floor, 'c0']].map(
               ([label, value, c]) => Object.assign({label, value, colour: c},
                   c === 'c3' && whole(g.ci95) ? {low: left(g, g.ci95[1]), high: left(g, g.ci95[0])} : {})),
               'times the noise', {log: true}),
      (result.effects || []).length && isNumber(g.removed_percent)
          ? html('p', {}, (g.removed_percent < 0 ? 'The effects do not shrink it: they remove '
                                                 : 'The effects remove ') +
                 `${percent(g.removed_percent)} of what fitting again leaves` +
                 (whole(g.ci95) ? ` (95 %: ${g.ci95.map(number).join(' to ')}).` : '.')) : null] : [];
    return [...part('Torque on motion that nothing was fitted to, mean square', result.gap.torque),
            ...part('Positions when it is simulated, mean square', result.gap.forward)];
  };

  const where = () => {
    if (!result.where) return null;
    const joints = result.where.joints, any = (result.effects || []).length > 0;
    const u = result.unexplained || {};
    const drawn = data.skeleton && skeleton([{points: data.skeleton.points}], data.skeleton.joints);
    const shade = (value, floor) => html('span', {class: 'shade', style:
        `background: color-mix(in srgb, var(--c2) ${Math.round(60 * beyond(value, floor))}%, transparent)`},
        number(value));
    const columns = [['model as it is', 'nominal_rms'], ['fitted again', 'refit_rms'],
                     ...(any ? [['with the effects', 'after_rms']] : [])];
    return [
      table(['joint', 'unit', ...columns.map(([title]) => title), 'noise', 'follows'],
            joints.map((j) => [j.name, j.unit, ...columns.map(([, key]) => shade(j[key], j.floor_rms)),
                               j.floor_rms, j.organised_by || '–'])),
      note('rms of what is left of the torque; clear at the noise, full orange at ten times the noise. ' +
           'Follows: what orders the residual most, if anything does.'),
      testable && u.share >= .01 ? html('p', {}, `No effect explains ${percent(100 * u.share)} of what fitting again leaves beyond ` +
          `the noise: most of it on ${u.joint}` + (u.organised_by ? `, where it follows ${u.organised_by}.` : '.')) : null,
      drawn ? heading('On the robot: ' + (any ? 'model as it is, and with the effects' : 'model as it is')) : null,
      drawn ? html('div', {class: 'beside'}, columns.filter(([, key]) => key !== 'refit_rms').map(
          ([title, key]) => html('figure', {}, [
            skeleton([{points: data.skeleton.points,
                       shares: joints.map((j) => beyond(j[key], j.floor_rms))}], data.skeleton.joints),
            html('figcaption', {class: 'faint'}, title + '; each link in the colour of the joint that moves it')])))
          : null];
  };

  const dataFindings = () => (result.data || []).length > 0 && [
    html('p', {}, 'The data cannot carry a diagnosis:'),
    list(result.data.map((d) => `${String(d.finding).replace(/_/g, ' ')}: ${d.evidence}` +
                                (d.flag ? ` (${d.flag})` : '')))];

  const untestable = () => {
    const why = new Map();
    for (const u of result.untestable || []) {
      const key = u.effect + ': ' + u.why;
      why.set(key, [...(why.get(key) || []), u.joint].filter((j) => j));
    }
    return why.size > 0 && list([...why].map(([text, joints]) =>
        text.replace(/_/g, ' ') + (joints.length ? ` (${joints.join(', ')})` : '')));
  };

  // -- verification --------------------------------------------------------------

  const checkNames = {
    torque_max_rel: 'torque', mass_matrix_max_rel: 'mass matrix', gravity_max_rel: 'gravity torque',
    energy_max_rel: 'energy', energy_drift_rel: 'energy drift of Simbody’s simulation',
    own_energy_drift_rel: 'energy drift of ours', own_consistency_rel: 'forward, then inverse dynamics'};
  const checks = () => data.command === 'verify' && table(
      ['check', 'largest (relative) difference', 'at most', ''],
      (result.checks || []).map((c) => [checkNames[c.name] || c.name.replace(/_/g, ' ')
          .replace('rollout ratio low', 'error of the simulation over the file’s, low end of its interval,'), c.value, c.threshold,
                                        c.passed ? '✓' : '✗ failed']));
  const rollouts = () => (result.rollout || []).length > 0 && result.rollout.flatMap((r) => [
    html('h3', {}, `${number(r.window_s)} s from the log’s states, rms of positions in ${r.unit}`),
    bars([{label: 'the file’s robot', value: r.before_rms, colour: 'c2',
           low: (r.before_ci95 || [])[0], high: (r.before_ci95 || [])[1]},
          {label: 'calibrated', value: r.after_rms, colour: 'c1',
           low: (r.ci95 || [])[0], high: (r.ci95 || [])[1]}], r.unit),
    note(`median of ${r.windows} windows with its 95 % interval` +
         (isNumber(r.ratio) ? `; the ratio is ${number(r.ratio)}` : ''))]);

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
    if (data.command === 'diagnose' || !data.skeleton || data.extra.postures) return null;
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

  const sections = [
    ['The data', dataFindings], ['Which effect', effects], ['What was only a wrong parameter', absorbed],
    ['How far the gap shrinks', gap], ['Where it lies', where],
    ['Joints', jointTable], ['Checks', checks], ['Simulated from the log', rollouts],
    ['The motion', motion], ['The postures', postures], ['What it will tell', predicted], ['Assumed', assumed],
    ['Geometry', geometry], ['Pose by pose', poses],
    ['Torque, recorded and predicted', torques], ['What the residual follows', maps],
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
