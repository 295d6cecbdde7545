'use strict';
// The sections of report.html, in the order in which they are read. Each takes
// the page's data and returns nodes, or null where it has nothing to show.
(() => {
  const {html, number, isNumber, table, bars, interval, correlations, skeleton} = charts;
  const data = JSON.parse(document.getElementById('data').textContent);
  const result = data.result;
  const graphs = [];

  const percent = (x) => isNumber(x) ? number(x) + ' %' : '–';
  const plusMinus = (value, stddev) =>
      isNumber(stddev) ? `${number(value)} ± ${number(stddev)}` : number(value);
  const note = (text) => html('p', {class: 'faint'}, text);
  const colour = (k) =>
      getComputedStyle(document.documentElement).getPropertyValue('--c' + k % 5).trim();
  const legend = (labels) => html('div', {class: 'legend'}, labels.map((label, k) => label &&
      html('span', {}, [html('span', {class: 'swatch', style: `background: var(--c${k % 5})`}),
                        label])));

  // -- what it comes to ---------------------------------------------------------

  const verdicts = {
    calibrate: () => {
      const passed = !result.verdict || result.verdict.passed;
      const held = result.validation_stacked_residual_percent;
      const left = result.stacked_residual_percent;
      const fit = !isNumber(left) ? [] : [`All but ${percent(left)} of the torque is explained` +
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
        `${number(last.ratio)} of what the file’s is.` : '';
  };

  const header = () => {
    const {good, sentence, reasons} = verdicts[data.command]();
    const button = html('button', {type: 'button'}, 'light / dark');
    button.addEventListener('click', () => {
      document.documentElement.classList.toggle('dark');
      restyle();
    });
    return html('header', {}, [
      html('div', {class: 'top'},
           [html('span', {class: 'faint'}, `armcal ${data.command} · ${data.robot}`), button]),
      html('div', {class: 'verdict ' + (good ? 'good' : 'bad')}, [
        html('h1', {}, (good ? '✓ ' : '✗ ') + sentence),
        reasons.length ? html('ul', {}, reasons.map((r) => html('li', {}, r))) : null])]);
  };

  // -- torques over time ---------------------------------------------------------

  // Columns of dygraphs with a low, a middle and a high value per signal.
  const rows = (t, joint, begin, end) => t.map((time, k) => [time].concat(
      joint.low.slice(begin, end).map((low, s) => {
        const high = joint.high[begin + s][k];
        return low[k] === null ? [null, null, null] : [low[k], (low[k] + high) / 2, high];
      })));

  const plot = (title, values, labels, options) => {
    const place = html('div', {class: 'plot'});
    const draw = () => new Dygraph(place, values, Object.assign({
      labels, title: undefined, legend: 'follow', strokeWidth: 1.3, fillAlpha: .3,
      colors: labels.slice(1).map((_, k) => colour(k)), axisLineColor: colour(0),
      gridLineColor: 'rgba(128,128,128,.22)', labelsKMB: false,
      digitsAfterDecimal: 4, highlightCircleSize: 3}, options));
    // Dygraphs measures its place, which must be in the page.
    graphs.push({place, draw});
    return html('div', {}, [html('h3', {}, title), place]);
  };

  const perLog = (make) => {
    if (data.torques.length === 0) return null;
    const place = html('div', {class: 'plots'});
    const show = (k) => {
      for (let g = graphs.length - 1; g >= 0; --g) {
        if (place.contains(graphs[g].place)) graphs.splice(g, 1);
      }
      place.replaceChildren(...make(data.torques[k]));
      if (place.isConnected) drawAll();
    };
    show(0);
    if (data.torques.length === 1) return place;
    const choice = html('select', {'aria-label': 'log'}, data.torques.map((trace, k) =>
        html('option', {value: k}, trace.log)));
    choice.addEventListener('change', () => show(Number(choice.value)));
    return html('div', {}, [choice, place]);
  };

  const torques = () => {
    const plots = perLog((trace) => {
      const labels = ['recorded', ...trace.labels];
      const shift = trace.labels.map((_, k) => colour(k + 1));
      return [legend(labels), ...trace.joints.flatMap((joint) => [
        plot(`${joint.name}, ${joint.unit}`, rows(trace.t, joint, 0, labels.length),
             ['s', ...labels], {customBars: true}),
        plot(`${joint.name}, recorded minus predicted, ${joint.unit}`,
             rows(trace.t, joint, labels.length, 2 * labels.length - 1),
             ['s', ...trace.labels], {customBars: true, colors: shift})])];
    });
    return plots && [plots, note('Drag to zoom, shift and drag to move, double click for all. ' +
        'Where a log has more samples than fit, the band holds the least and the largest.')];
  };

  const spectra = () => {
    const traces = data.torques.filter((trace) => trace.spectrum);
    if (traces.length === 0) return null;
    const trace = traces[0];
    const {f, density} = trace.spectrum;
    const shift = trace.labels.map((_, k) => colour(k + 1));
    return [legend(['', ...trace.labels]), ...trace.joints.map((joint, j) => plot(
        `${joint.name}, ${joint.unit}/√Hz`,
        f.slice(1).map((x, k) => [x].concat(density.map((m) => Math.sqrt(m[j][k + 1])))),
        ['Hz', ...trace.labels], {logscale: true, colors: shift})),
      note(`Of recorded minus predicted torque in ${trace.log}. A flat line is noise; a peak is a ` +
           'vibration, a rise at low frequencies what the model lacks.')];
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
        ['parameter', 'value ± standard deviation', 'unit', ...(prior ? ['file'] : []), '95 %'],
        list.map((p) => [
          p.name, plusMinus(p.value, p.stddev), p.unit,
          ...(prior ? [isNumber(p.prior) ? number(p.prior) : '–'] : []),
          p.identifiable === false ? html('span', {class: 'faint'}, 'the data do not tell')
                                   : interval(p.value, p.stddev, p.prior)]), true);
  };

  const parameters = () => {
    if (data.command !== 'calibrate') return null;
    const physical = (result.parameters || []).filter((p) => isNumber(p.value));
    return [
      html('h3', {}, 'Model parameters, which torques determine'),
      parameterTable(result.model_parameters),
      physical.length && result.estimate === 'refined'
          ? html('h3', {}, 'A robot for a simulator; the file is the orange mark') : null,
      physical.length && result.estimate === 'refined' ? parameterTable(physical) : null];
  };

  const correlation = () => {
    const {names, values} = data.extra.correlation || {};
    return names && [correlations(names, values),
                     note('Orange: errors go together; blue: against each other.')];
  };

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

  const geometry = () => (result.geometry || []).length > 0 && table(
      ['length', 'file', 'used', ''],
      result.geometry.map((g) => [g.symbol || g.name, isNumber(g.nominal) ? g.nominal : '–',
                                  isNumber(g.used) ? g.used : g.value,
                                  g.identifiable === false ? 'the data do not tell' : '']));

  // -- diagnosis -----------------------------------------------------------------

  const effects = () => {
    if (data.command !== 'diagnose') return null;
    const list = result.candidates || [];
    const found = result.effects || [];
    const name = (c) => String(c.effect).replace(/_/g, ' ') +
        (c.joint ? ' on ' + c.joint : jointName(c.joint_index));
    const chart = bars(list.slice(0, 12).map((c) => ({
      label: name(c), value: 100 * c.probability, colour: c.probability >= .8 ? 'c2' : 'c1',
      note: Math.round(100 * c.probability) + ' %'})), '%', {title: 'probabilities of effects'});
    return [
      chart || note('No effect is claimed.'),
      found.length ? table(['effect', 'size', 'removes of the gap', 'cannot be told from'],
        found.map((e) => [
          name(e),
          (e.estimates || []).map((s) => `${s.name} ${plusMinus(s.value, s.stddev)} ${s.unit}`).join(', '),
          isNumber(e.removed_percent)
              ? `${percent(e.removed_percent)} [${(e.ci95 || []).map(number).join(', ')}]` : '–',
          (e.equivalent || []).join(', ') || '–'])) : null,
      ...found.filter((e) => e.separate_by).map((e) => note(e.separate_by))];
  };
  const jointName = (index) => index > 0 && result.where && result.where.joints[index - 1]
      ? ' on ' + result.where.joints[index - 1].name : '';

  const gap = () => {
    if (!result.gap) return null;
    const part = (title, g) => g && [
      html('h3', {}, title),
      bars([['model as it is', g.nominal, 'c4'], ['fitted again', g.refit, 'c1'],
            ['with the effects', g.after, 'c3'], ['noise', g.floor, 'c0']].map(
               ([label, value, c]) => ({label, value, colour: c})), '', {log: true, title}),
      isNumber(g.removed_percent) ? html('p', {}, `The effects remove ${percent(g.removed_percent)} of ` +
          'what fitting again leaves' +
          (g.ci95 ? ` (95 %: ${g.ci95.map(number).join(' to ')}).` : '.')) : null];
    return [...(part('Torque on held-out motion, mean square over the noise’s', result.gap.torque) || []),
            ...(part('Positions when it is simulated, mean square over the noise’s',
                     result.gap.forward) || [])];
  };

  const where = () => {
    if (!result.where) return null;
    const joints = result.where.joints;
    // None at the noise, full at ten times the noise.
    const beyond = (value, floor) => Math.min(1, Math.max(0, Math.log10(value / floor)));
    const shade = (value, floor) => {
      const share = beyond(value, floor);
      return html('span', {style: `display: inline-block; min-width: 92px; padding: 2px 8px;` +
          `background: color-mix(in srgb, var(--c2) ${Math.round(60 * share)}%, transparent)`},
          number(value));
    };
    return [
      table(['joint', 'unit', 'model as it is', 'fitted again', 'with the effects', 'noise', 'follows'],
            joints.map((j) => [j.name, j.unit, shade(j.nominal_rms, j.floor_rms),
                               shade(j.refit_rms, j.floor_rms), shade(j.after_rms, j.floor_rms),
                               number(j.floor_rms), j.organised_by || '–'])),
      data.skeleton ? html('h3', {}, 'Where on the robot (orange: the model as it is, beyond the noise)') : null,
      data.skeleton ? skeleton(data.skeleton.points, data.skeleton.joints,
                               joints.map((j) => beyond(j.nominal_rms, j.floor_rms))) : null];
  };

  const untestable = () => {
    const list = result.untestable || [];
    if (list.length === 0) return null;
    const why = new Map();
    for (const u of list) {
      const key = u.effect + ': ' + u.why;
      why.set(key, [...(why.get(key) || []), u.joint].filter((j) => j));
    }
    return html('ul', {}, [...why].map(([text, joints]) => html('li', {},
        text.replace(/_/g, ' ') + (joints.length ? ` (${joints.join(', ')})` : ''))));
  };

  // -- verification --------------------------------------------------------------

  const checkNames = {
    torque_max_rel: 'torque', mass_matrix_max_rel: 'mass matrix', gravity_max_rel: 'gravity torque',
    energy_max_rel: 'energy', energy_drift_rel: 'energy drift of Simbody’s simulation',
    own_energy_drift_rel: 'energy drift of ours', own_consistency_rel: 'forward, then inverse dynamics'};
  const checks = () => data.command === 'verify' && table(
      ['check', 'largest relative difference', 'at most', ''],
      (result.checks || []).map((c) => [checkNames[c.name] || c.name.replace(/_/g, ' '), c.value, c.threshold,
                                        c.passed ? '✓' : '✗ failed']));
  const rollouts = () => (result.rollout || []).length > 0 && result.rollout.flatMap((r) => [
    html('h3', {}, `${number(r.window_s)} s from the log’s states, rms of positions in ${r.unit}`),
    bars([{label: 'the file’s robot', value: r.before_rms, colour: 'c4',
           low: (r.before_ci95 || [])[0], high: (r.before_ci95 || [])[1]},
          {label: 'calibrated', value: r.after_rms, colour: 'c3',
           low: (r.ci95 || [])[0], high: (r.ci95 || [])[1]}], r.unit),
    note(`median of ${r.windows} windows with its 95 % interval` +
         (isNumber(r.ratio) ? `; the ratio is ${number(r.ratio)}` : ''))]);

  // -- design --------------------------------------------------------------------

  const motion = () => {
    const m = data.extra.motion;
    return m && [legend(['position', 'velocity']), ...m.joints.map((joint, j) => plot(
        `${joint.name}, ${joint.unit} and ${joint.unit}/s`,
        m.t.map((t, k) => [t, m.q[j][k], m.qd[j][k]]), ['s', 'position', 'velocity'], {})),
      table(['joint', 'from', 'to', 'velocity up to', 'acceleration up to'],
            (result.joints || []).map((l) => [l.name, l.lower, l.upper, l.velocity, l.acceleration]))];
  };
  const predicted = () => data.command === 'excite' && (result.parameters || []).length > 0 && table(
      ['quantity', 'predicted standard deviation', 'before', 'unit'],
      result.parameters.map((p) => [p.name, number(p.stddev),
        isNumber(p.given_stddev) ? number(p.given_stddev)
            : isNumber(p.random_stddev) ? number(p.random_stddev) : '–', p.unit]), true);
  const assumed = () => (result.assumed || []).length > 0 &&
      html('ul', {}, result.assumed.map((a) => html('li', {}, a)));

  // -- where it comes from -------------------------------------------------------

  const robot = () => data.command !== 'diagnose' && data.skeleton &&
      [skeleton(data.skeleton.points, data.skeleton.joints, null),
       note('Joint axes of the robot file, at a bent posture. Drag, or use the arrow keys.')];

  const provenance = () => {
    const p = data.provenance;
    return [
      html('p', {}, html('code', {}, p.arguments.join(' '))),
      p.files.length ? table(['file', 'bytes', 'SHA-256'], p.files.map((f) =>
          [f.path, String(f.bytes), html('code', {}, f.sha256)])) : null,
      note(Object.entries(p.versions).map(([name, v]) => `${name} ${v}`).join(', '))];
  };

  const sections = [
    ['Which effect', effects], ['How far the gap shrinks', gap], ['Where it lies', where],
    ['Joints', jointTable], ['Checks', checks], ['Simulated from the log', rollouts],
    ['The motion', motion], ['What it will tell', predicted], ['Assumed', assumed],
    ['Torque, recorded and predicted', torques], ['Spectrum of what is left', spectra],
    ['Parameters', parameters], ['Correlations', correlation], ['What the logs show', rank],
    ['Geometry', geometry], ['Not testable on these data', untestable], ['The robot', robot],
    ['Where this comes from', provenance]];

  const drawAll = () => {
    for (const graph of graphs) {
      if (!graph.chart) graph.chart = graph.draw();
    }
  };
  const restyle = () => {
    for (const graph of graphs) {
      if (graph.chart) graph.chart.destroy();
      graph.chart = graph.draw();
    }
  };

  if (matchMedia('(prefers-color-scheme: dark)').matches) {
    document.documentElement.classList.add('dark');
  }
  document.title = `armcal ${data.command}: ${data.robot}`;
  const page = document.getElementById('page');
  page.append(header());
  const menu = html('nav', {'aria-label': 'sections'});
  page.append(menu);
  sections.forEach(([title, make], k) => {
    const nodes = [].concat(make() || []).filter((node) => node);
    if (nodes.length === 0) return;
    const id = 'section-' + k;
    menu.append(html('a', {href: '#' + id}, title));
    page.append(html('section', {id}, [html('h2', {}, title), ...nodes]));
  });
  drawAll();
  document.documentElement.dataset.ready = 'true';
})();
