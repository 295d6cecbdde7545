'use strict';
// Of a series of logs: which parameters changed from log to log, and a panel
// over the logs for each parameter that did, and for every joint's friction.
const changeSections = (data) => {
  const {html, svg, number, isNumber, table, percent, plusMinus, note, heading} = charts;
  const told = data.result.changes;

  const shortName = (path) => String(path).split('/').slice(-2).join('/');
  const amount = (a) => {
    if (!isNumber(a.value)) return `${a.name} not seen`;
    if (a.unit === '1') return `${a.name} ${plusMinus(100 * a.value, 100 * a.stddev)} %`;
    return `${a.name} ${plusMinus(a.value, a.stddev)} ${a.unit}` +
        (isNumber(a.relative) ? ` (${a.relative > 0 ? '+' : ''}${percent(100 * a.relative)})` : '');
  };
  // All friction has each joint's after the mean; a mass its inertia after the moments.
  const shown = (c) => c.part === 'all_friction' ? c.amounts.filter((a) => !a.name.includes(' '))
                                                 : c.amounts.slice(0, 4);
  const rows = (list) => list.map((c) => [
    c.sentence, shortName(c.log_name), shown(c).map(amount).join(', '), percent(100 * c.probability),
    [c.reading, ...c.rivals.map((r) => `or ${percent(100 * r.probability)} ${r.change.replace(/_/g, ' ')}`)].join('; ')]);
  const titles = ['what', 'log', 'by how much', 'probability', 'as a rule'];

  // One parameter: each log's estimate with its 95 % interval, the line of the
  // changes with a band of two standard deviations of what logs differ by
  // anyway, and a tick at each log where a step or a drift begins.
  const panel = (p, marks) => {
    const width = 360, height = 150, left = 46, right = 8, top = 8, bottom = 24;
    const logs = p.value.length;
    const ends = [];
    p.value.forEach((v, l) => {
      ends.push(p.model[l] - 2 * p.scatter, p.model[l] + 2 * p.scatter);
      if (isNumber(v) && isNumber(p.stddev[l])) ends.push(v - p.stddev[l], v + p.stddev[l]);
    });
    const low = Math.min(...ends), high = Math.max(...ends);
    const margin = .12 * (high - low) || Math.abs(high) || 1;
    const x = (l) => left + (width - left - right) * (logs > 1 ? l / (logs - 1) : .5);
    const y = (v) => top + (height - top - bottom) *
        (1 - Math.min(1, Math.max(0, (v - low + margin) / (high - low + 2 * margin))));
    const parts = [];
    const edge = (sign) => p.model.map((v, l) => `${x(l).toFixed(1)} ${y(v + sign * 2 * p.scatter).toFixed(1)}`);
    parts.push(svg('path', {d: `M${edge(1).join('L')}L${edge(-1).reverse().join('L')}Z`, style: 'fill: var(--noise)'}));
    for (const mark of marks) {
      parts.push(svg('path', {d: `M${x(mark - .5)} ${top}V${height - bottom}`, 'stroke-dasharray': '3 3',
                              style: 'stroke: var(--c2); stroke-width: 1.5'}));
    }
    // A step lies between two logs.
    const line = p.model.map((v, l) => (l === 0 ? 'M' : marks.includes(l)
        ? `H${x(l - .5).toFixed(1)}V${y(v).toFixed(1)}L` : 'L') + `${x(l).toFixed(1)} ${y(v).toFixed(1)}`).join('');
    parts.push(svg('path', {d: line,
                            style: 'stroke: var(--c2); stroke-width: 2; fill: none'}));
    p.value.forEach((v, l) => {
      if (!isNumber(v) || !isNumber(p.stddev[l])) return;
      const reach = 1.96 * p.stddev[l];
      parts.push(svg('path', {d: `M${x(l).toFixed(1)} ${y(v - reach).toFixed(1)}V${y(v + reach).toFixed(1)}`,
                              style: 'stroke: var(--c1); stroke-width: 1.5'}));
      parts.push(svg('circle', {cx: x(l), cy: y(v), r: 3, style: 'fill: var(--c1)'},
                     svg('title', {}, `log ${l + 1}, ${shortName(told.logs[l])}: ${plusMinus(v, p.stddev[l])} ${p.unit}`)));
    });
    parts.push(svg('path', {d: `M${left} ${top}V${height - bottom}H${width - right}`, class: 'axis', style: 'fill: none'}));
    for (const v of [low, high]) {
      parts.push(svg('text', {x: left - 4, y: y(v) + 3, class: 'small', 'text-anchor': 'end'}, number(Number(v.toPrecision(3)))));
    }
    parts.push(svg('text', {x: left, y: height - 8, class: 'small'}, 'log 1'));
    parts.push(svg('text', {x: width - right, y: height - 8, class: 'small', 'text-anchor': 'end'}, String(logs)));
    return html('figure', {}, [
      svg('svg', {viewBox: `0 0 ${width} ${height}`, role: 'img',
                  'aria-label': `${p.name} over ${logs} logs: from ${number(p.model[0])} to ${number(p.model[logs - 1])} ${p.unit}`},
          parts),
      html('figcaption', {class: 'faint'}, `${p.name}, ${p.unit}`)]);
  };

  // Those that the changes move by more than what logs differ by; those of
  // friction and offsets in any case.
  const moved = (p) => Math.max(...p.model) - Math.min(...p.model) > Math.max(1e-12, 2 * p.scatter);
  const marksOf = (p) => !moved(p) ? [] : told.changes.filter((c) => c.kind === 'step' &&
      Math.abs(p.model[c.log - 1] - p.model[c.log - 2]) > .1 * (Math.max(...p.model) - Math.min(...p.model)))
      .map((c) => c.log - 1);
  const known = (p) => p.stddev.filter(isNumber).length > 1;
  const panels = (title, list) => list.length > 0 && [
    heading(title), html('div', {class: 'beside'}, list.map((p) => panel(p, marksOf(p))))];

  const changes = () => {
    if (!told) return null;
    if (told.reason) return note('Not told: ' + told.reason);
    const series = told.series.filter(known);
    const rest = series.filter((p) => !moved(p) && p.joint_term);
    return [
      told.changes.length ? table(titles, rows(told.changes))
                          : html('p', {}, 'No step and no drift, beyond what logs differ by anyway.'),
      ...(told.single_logs.length ? [heading('Single logs that differ, by their motion or their day'),
                                     table(titles, rows(told.single_logs))] : []),
      ...(panels('Parameters that changed', series.filter(moved)) || []),
      ...(panels('Friction, offsets and armature that did not', rest) || []),
      note('Dots: each log by itself with its 95 % interval. Line: the changes; the band is two standard deviations of ' +
           'what logs differ by beside them. Dashes: where a step happens, between two logs.')];
  };

  return {changes};
};
