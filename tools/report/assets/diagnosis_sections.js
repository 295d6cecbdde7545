'use strict';
// Of a diagnosis: its data, effects, absorbed parameters, how far the gap
// shrinks and where it lies.
const diagnosisSections = (data) => {
  const {html, number, isNumber, table, bars, interval, beyond, skeleton, percent, plusMinus,
         note, heading, list} = charts;
  const result = data.result;

  const ofPoses = String(result.format).startsWith('armcal pose diagnosis');  // pose_sections.js
  const testable = result.verdict !== 'not_testable' && !ofPoses;
  const whole = (interval) => (interval || []).length === 2 && interval.every(isNumber);
  const effects = () => {
    if (data.command !== 'diagnose' || !testable) return null;
    const candidates = (result.candidates || []).slice(0, 12);
    const found = result.effects || [];
    const name = (c) => String(c.effect).replace(/_/g, ' ') +
        (c.joint ? ' on ' + c.joint : jointName(c.joint_index));
    const unnamed = (result.fitted_not_named || []).filter((e) => !e.one_of_few);
    const isUnnamed = (c) => unnamed.some((e) => e.effect === c.effect && e.joint_index === c.joint_index);
    const chart = bars(candidates.map((c) => ({
      label: name(c), value: 100 * c.probability, colour: c.probability >= .8 ? 'c2' : 'c1',
      note: (c.probability < .005 ? 'less than 1 %' : Math.round(100 * c.probability) + ' %') +
          (isUnnamed(c) ? ', not claimed' : '')})), '%', {top: 100});
    return [
      chart ? heading('How likely each is') : null,
      chart || html('p', {}, 'No effect is claimed.'),
      candidates.some(isUnnamed) ? note('Not claimed: fitted, but what was held out, or what else may ' +
          'explain it, does not bear it out. It is in no figure here.') : null,
      found.length ? table(['effect', 'size', 'removes of the gap', 'cannot be told from'],
        found.map((e) => [
          name(e),
          (e.estimates || []).map((s) => `${s.name} ${plusMinus(s.value, s.stddev)} ${s.unit}`).join(', '),
          isNumber(e.removed_percent)
              ? percent(e.removed_percent) + (whole(e.ci95) ? ` [${e.ci95.map(number).join(', ')}]` : '') : '–',
          (e.equivalent || []).map((q) => typeof q === 'string' ? q : name(q)).join(', ') || '–'])) : null,
      found.some((e) => isNumber(e.removed_percent)) ? note('Of the gap that fitting again leaves, on motion that ' +
          'the model was not fitted to' + (found.some((e) => whole(e.ci95)) ? '; in brackets its 95 % interval.' : '.')) : null,
      ...((result.next || []).length ? [heading('What to do next'), list(result.next)] : [])];
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
    if (!result.gap || ofPoses) return null;
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
    return [...part('Torque on motion that the model was not fitted to, mean square', result.gap.torque),
            ...part('Positions when it is simulated, mean square', result.gap.forward)];
  };

  const where = () => {
    if (!result.where || ofPoses) return null;
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

  return {dataFindings, effects, absorbed, gap, where, untestable};
};
