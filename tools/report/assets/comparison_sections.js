'use strict';
// Sections of armcal compare: which results, and how far their values are apart.
const comparisonSections = (data) => {
  const {html, number, isNumber, table, bars, note} = charts;
  const result = data.result;
  const is = data.command === 'compare';
  const letter = (k) => String.fromCharCode(65 + k);
  const MOST_BARS = 12;

  const compared = () => is && table(['', 'result', 'of', 'robot', ''], result.results.map((r, k) =>
      [letter(k), r.file, r.kind, r.robot, r.verdict]));

  const shown = (value, stddev) => isNumber(stddev) && stddev > 0
      ? `${number(value)} ± ${number(stddev)}` : number(value);
  const apart = (d) => isNumber(d.deviations) ? Math.abs(d.deviations) : 0;
  const order = (values) => [...values].sort((a, b) => (b.differs - a.differs) || apart(b) - apart(a));

  const pairNodes = (pair) => {
    const values = order(pair.values);
    const known = values.filter((d) => isNumber(d.deviations)).slice(0, MOST_BARS);
    const [a, b] = [letter(pair.a), letter(pair.b)];
    return [
      html('h3', {}, `${a} and ${b}: ${pair.agrees ? 'agree' : 'disagree'}`),
      pair.degrees > 0 ? note(`All values together: their squares sum up to ${number(pair.sum_of_squares)}, ` +
          `by noise alone with a probability ${pair.probability < 1e-12 ? 'below 1e-12'
              : `of ${number(pair.probability)}`}.`) : null,
      known.length ? bars(known.map((d) => ({label: d.name, value: apart(d), colour: d.differs ? 'c2' : 'c1'})),
                          'deviations') : null,
      table(['value', a, b, 'unit', `${b} − ${a}, deviations`, ''], values.map((d) =>
          [d.name, shown(d.a, d.a_stddev), shown(d.b, d.b_stddev), d.unit,
           isNumber(d.deviations) ? number(d.deviations) : '–', d.differs ? 'differ' : '']), values.length > 20),
      pair.only_a.length + pair.only_b.length > 0 ? note(`Known to one alone, not compared: ${pair.only_a.length} of ` +
          `${a}, ${pair.only_b.length} of ${b}.`) : null];
  };
  const comparedValues = () => is && result.pairs.flatMap(pairNodes);

  const comparedTorques = () => is && result.held_out && [
    bars(result.held_out.results.map((r, k) => ({label: letter(k), value: r.stacked_percent, colour: 'c1'})), '%'),
    note(`Of the torque, low-passed at ${number(result.held_out.bandwidth_hz)} Hz.`),
    table(['', 'times as much as', 'ratio', '95 %'], result.held_out.ratios.map((r) =>
        [letter(r.b), letter(r.a), number(r.ratio), `${number(r.ci95[0])} to ${number(r.ci95[1])}`]))];

  return {compared, comparedValues, comparedTorques};
};
