'use strict';
// Drawings that need no library: elements, tables, bars, intervals, profiles, a
// heat map and a robot's skeleton. Text goes in through textContent only.
const charts = (() => {
  const kSvg = 'http://www.w3.org/2000/svg';

  const put = (node, attributes, children) => {
    for (const [name, value] of Object.entries(attributes || {})) {
      if (value === undefined || value === null) continue;
      node.setAttribute(name, value);
    }
    for (const child of [].concat(children === undefined ? [] : children)) {
      if (child === null || child === undefined || child === false) continue;
      node.append(child instanceof Node ? child : String(child));
    }
    return node;
  };
  const html = (tag, attributes, children) =>
      put(document.createElement(tag), attributes, children);
  const svg = (tag, attributes, children) =>
      put(document.createElementNS(kSvg, tag), attributes, children);

  const isNumber = (x) => typeof x === 'number' && isFinite(x);
  // Four digits, as a person would write them.
  const number = (x) => {
    if (!isNumber(x)) return '–';
    if (x === 0) return '0';
    const size = Math.abs(x);
    const text = size >= 1e5 || size < 1e-3 ? x.toExponential(2)
                                            : String(Number(x.toPrecision(4)));
    return text.replace(/-/g, '−');
  };
  // Names may be of any length; the whole stands in a title.
  const shortened = (text, most) =>
      [...String(text)].length > most ? [...String(text)].slice(0, most - 1).join('') + '…' : String(text);

  // In words.
  const percent = (x) => !isNumber(x) ? '–'
      : (Math.abs(x) < 10 ? number(Number(x.toPrecision(2))) : number(Number(x.toFixed(1)))) + ' %';
  // The deviation with two digits, the value with as many decimals.
  const plusMinus = (value, stddev) => {
    if (!isNumber(stddev)) return number(value);
    const decimals = Math.max(0, 1 - Math.floor(Math.log10(stddev)));
    return !(stddev > 0) || decimals > 7 || Math.max(Math.abs(value), stddev) >= 1e5
        ? `${number(value)} ± ${number(stddev)}`
        : `${value.toFixed(decimals)} ± ${stddev.toFixed(decimals)}`.replace(/-/g, '−');
  };
  const note = (text) => html('p', {class: 'faint'}, text);
  const heading = (text) => html('h3', {}, text);
  const list = (items) => html('ul', {}, items.map((item) => html('li', {}, item)));

  // What a line of each kind looks like: colour, dashes and width, so that
  // none carries the meaning alone.
  const styles = {
    recorded: {colour: 'recorded', dash: null, width: 3.5},
    'the robot file': {colour: 'c2', dash: [7, 4]},
    'as in the reference': {colour: 'c2', dash: [7, 4]},
    'fitted again': {colour: 'c1', dash: [2, 3]},
    'the geometry alone': {colour: 'c1', dash: [2, 3]},
    'with the effects': {colour: 'c3', dash: null},
    calibrated: {colour: 'c1', dash: null},
    'calibrated, for a simulator': {colour: 'c3', dash: [2, 3]},
    position: {colour: 'c1', dash: null}, velocity: {colour: 'c2', dash: [7, 4]},
    command: {colour: 'c2', dash: [7, 4]}, torque: {colour: 'c3', dash: null}};
  const styleOf = (label) => styles[label] || {colour: 'c4', dash: null};
  const legend = (labels) => html('div', {class: 'legend'}, labels.map((label) => {
    const {colour, dash, width} = styleOf(label);
    return html('span', {}, [
      svg('svg', {width: 30, height: 10, 'aria-hidden': 'true'}, svg('path', {
        d: 'M1 5H29', style: `stroke: var(--${colour}); stroke-width: ${width ? 5 : 2.5}; fill: none`,
        'stroke-dasharray': dash && dash.join(' ')})), label]);
  }));

  // rows: [[cell]]; a cell is a text, a number or a node.
  const table = (titles, rows, long) => {
    const cell = (tag, value) => html(
        tag, {class: isNumber(value) ? 'number' : null,
              scope: tag === 'th' ? 'col' : null},
        isNumber(value) ? number(value) : value);
    const body = rows.map((row) => html('tr', {}, row.map((x) => cell('td', x))));
    const scrolls = long && rows.length > 16;
    return html('div', scrolls ? {class: 'scroll long', tabindex: 0, role: 'region',
                                  'aria-label': 'table: ' + titles.filter((t) => t).join(', ')}
                               : {class: 'scroll'},
                html('table', {}, [
                  html('thead', {}, html('tr', {}, titles.map((t) => cell('th', t)))),
                  html('tbody', {}, body)]));
  };

  // rows: [{label, value, low, high, colour, note}]; interval optional.
  const bars = (rows, unit, options = {}) => {
    const shown = rows.filter((r) => isNumber(r.value));
    if (shown.length === 0) return null;
    const values = shown.map((r) => r.value);
    const top = options.top || Math.max(...shown.map((r) => Math.max(r.value, r.high || 0)), 1e-300);
    const log = options.log && Math.min(...values) > 0 && top / Math.min(...values) > 50;
    const least = log ? Math.min(...values) / 2 : 0;
    const share = (value) => 100 * Math.min(1, Math.max(0, log
        ? Math.log(Math.max(value, least) / least) / Math.log(top / least) : value / top));
    const parts = shown.flatMap((r) => {
      const said = r.note || number(r.value) + (unit ? ' ' + unit : '') +
          (isNumber(r.low) && isNumber(r.high) ? ` (${number(r.low)} to ${number(r.high)})` : '');
      const whole = isNumber(r.low) && isNumber(r.high);
      return [
        html('span', {class: 'bar-label'}, r.label),
        html('span', {class: 'bar-track', 'aria-hidden': 'true'}, [
          html('span', {class: 'bar', style: `width: ${share(r.value)}%; background: var(--${r.colour || 'c1'})`}),
          whole && html('span', {class: 'whisker',
            style: `left: ${share(r.low)}%; width: ${share(r.high) - share(r.low)}%`})]),
        html('span', {class: 'bar-value'}, said)];
    });
    return html('div', {}, [html('div', {class: 'bars'}, parts),
                            log ? html('p', {class: 'faint'}, 'Lengths are logarithms: these are far apart.') : null]);
  };

  // A value with its 95 % interval and what was thought before, on a line.
  const interval = (value, stddev, prior) => {
    const reach = isNumber(stddev) ? 1.96 * stddev : 0;
    const ends = [value - reach, value + reach].concat(isNumber(prior) ? [prior] : []);
    const low = Math.min(...ends), high = Math.max(...ends);
    const span = high > low ? high - low : 1;
    const x = (v) => 6 + 148 * (v - low) / span;
    return svg('svg', {width: 160, height: 16, 'aria-hidden': 'true'}, [
      svg('path', {d: `M${x(value - reach)} 8H${x(value + reach)}`,
                   style: 'stroke: var(--c1); stroke-width: 3'}),
      svg('circle', {cx: x(value), cy: 8, r: 4, style: 'fill: var(--c1)'}),
      isNumber(prior) ? svg('path', {d: `M${x(prior)} 2v12`,
                                     style: 'stroke: var(--c2); stroke-width: 2.5'}) : null]);
  };

  // Beyond the noise: 0 at the noise, 1 at ten times the noise.
  const beyond = (value, floor) =>
      isNumber(value) && floor > 0 ? Math.min(1, Math.max(0, Math.log10(value / floor))) : 0;

  // One small panel: bins' means of several models as steps, the noise as a
  // band, and under it a strip per model, the darker the farther the rms of a
  // bin is beyond the noise. over: {begin, width, mean, rms}.
  const profile = (title, unit, over, labels, reach, floor) => {
    const width = 200, height = 84, strip = 7, left = 4, base = height + 4;
    const bins = over.mean[0].length, end = over.begin + bins * over.width;
    const x = (k) => left + (width - 2 * left) * k / bins;
    const y = (v) => height / 2 - (height / 2 - 3) * Math.max(-1, Math.min(1, v / reach));
    const parts = [];
    if (floor > 0) {
      const band = Math.min(height / 2, y(-floor) - height / 2);
      parts.push(svg('rect', {x: left, width: width - 2 * left, y: height / 2 - band, height: 2 * band,
                              style: 'fill: var(--noise)'}));
    }
    parts.push(svg('path', {d: `M${left} ${height / 2}H${width - left}`, class: 'axis'}));
    over.mean.forEach((mean, m) => {
      let d = '', pen = 'M';
      mean.forEach((v, k) => {
        if (v === null) { pen = 'M'; return; }
        d += `${pen}${x(k).toFixed(1)} ${y(v).toFixed(1)}H${x(k + 1).toFixed(1)}`;
        pen = 'L';
      });
      const {colour, dash} = styleOf(labels[m]);
      parts.push(svg('path', {d, 'stroke-dasharray': dash && dash.map((s) => s * .6).join(' '),
        style: `stroke: var(--${colour}); stroke-width: 2; fill: none`}));
      if (!(floor > 0)) return;
      over.rms[m].forEach((rms, k) => rms !== null && parts.push(svg('rect', {
        x: x(k), width: x(1) - x(0) + .3, y: base + m * (strip + 1), height: strip,
        style: `fill: color-mix(in srgb, var(--c2) ${Math.round(100 * beyond(rms, floor))}%, var(--panel))`})));
    });
    const bottom = base + (floor > 0 ? labels.length * (strip + 1) : 0) + 13;
    parts.push(svg('text', {x: left, y: bottom, class: 'small'}, number(over.begin)));
    parts.push(svg('text', {x: width / 2, y: bottom, class: 'small', 'text-anchor': 'middle'},
                   title + (unit ? ', ' + unit : '')));
    parts.push(svg('text', {x: width - left, y: bottom, class: 'small', 'text-anchor': 'end'}, number(end)));
    const most = labels.map((label, m) => `${label}: mean up to ${number(Math.max(
        ...over.mean[m].map((v) => Math.abs(v || 0))))}`).join('; ');
    return svg('svg', {viewBox: `0 0 ${width} ${bottom + 4}`, role: 'img',
                       'aria-label': `what is left over ${title}: ${most}`}, parts);
  };

  // values: rows of numbers from -1 to 1; blue to orange through the paper.
  const correlations = (names, values) => {
    const canvas = html('canvas', {role: 'img', tabindex: 0,
      'aria-label': 'correlations of parameters; arrow keys read them'});
    const size = names.length, cell = Math.max(4, Math.min(18, Math.floor(640 / size)));
    const written = cell >= 11, margin = written ? 150 : 0, sharp = 2;
    const side = cell * size + margin;
    canvas.width = canvas.height = sharp * side;
    canvas.style.width = side + 'px';
    const pen = canvas.getContext('2d');
    const draw = () => {
      const ink = getComputedStyle(document.documentElement).getPropertyValue('--ink');
      pen.setTransform(sharp, 0, 0, sharp, 0, 0);
      pen.clearRect(0, 0, side, side);
      values.forEach((row, r) => row.forEach((v, c) => {
        const share = isNumber(v) ? Math.min(1, Math.abs(v)) : 0;
        pen.fillStyle = !isNumber(v) ? 'rgba(128,128,128,.25)'
            : v > 0 ? `rgba(213,94,0,${share})` : `rgba(0,114,178,${share})`;
        pen.fillRect(margin + c * cell, margin + r * cell, cell, cell);
      }));
      pen.strokeStyle = 'rgba(128,128,128,.6)';
      pen.strokeRect(margin + .5, margin + .5, cell * size - 1, cell * size - 1);
      if (!written) return;
      pen.fillStyle = ink;
      pen.font = '11px system-ui, "DejaVu Sans", sans-serif';
      pen.textAlign = 'right';
      pen.textBaseline = 'middle';
      names.forEach((name, k) => {
        pen.fillText(shortened(name, 24), margin - 5, margin + (k + .5) * cell, margin - 8);
        pen.save();
        pen.translate(margin + (k + .5) * cell, margin - 5);
        pen.rotate(Math.PI / 2);
        pen.fillText(shortened(name, 24), 0, 0, margin - 8);
        pen.restore();
      });
    };
    const said = html('p', {class: 'faint', 'aria-live': 'polite'},
                      'Point at a cell, or use the arrow keys, to read it.');
    let at = [0, 0];
    const tell = (r, c) => {
      at = [r, c].map((k) => Math.max(0, Math.min(size - 1, k)));
      said.textContent = `${names[at[0]]} and ${names[at[1]]}: ${number(values[at[0]][at[1]])}`;
    };
    canvas.addEventListener('mousemove', (event) => {
      const box = canvas.getBoundingClientRect();
      const place = (x, whole) => Math.floor((side * x / whole - margin) / cell);
      tell(place(event.clientY - box.top, box.height), place(event.clientX - box.left, box.width));
    });
    canvas.addEventListener('keydown', (event) => {
      const step = {ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowUp: [-1, 0], ArrowDown: [1, 0]}[event.key];
      if (!step) return;
      event.preventDefault();
      tell(at[0] + step[0], at[1] + step[1]);
    });
    draw();
    canvas.redraw = draw;
    return html('div', {}, [html('div', {class: 'scroll'}, canvas), said]);
  };

  // The strongest of them in words: [[name, name, value]].
  const strongest = (names, values, least, most) => {
    const pairs = [];
    for (let r = 0; r < names.length; ++r) {
      for (let c = 0; c < r; ++c) {
        if (Math.abs(values[r][c]) >= least) pairs.push([names[c], names[r], values[r][c]]);
      }
    }
    return pairs.sort((a, b) => Math.abs(b[2]) - Math.abs(a[2])).slice(0, most);
  };

  // chains: [{points: [[x, y, z]], colour, width, dash, opacity, shares}], the
  // names at the joints of the first; shares: per segment 0 to 1. Turned with
  // the mouse or the arrow keys.
  // Null where all is one point. Segments go from each point to the one before
  // or, of a robot that branches, to the one that charts.before says.
  const skeleton = (chains, names) => {
    const size = 420, tall = 330, all = chains.flatMap((chain) => chain.points);
    if (all.every((p) => Math.hypot(...p.map((x, k) => x - all[0][k])) < 1e-6)) return null;
    const view = svg('svg', {viewBox: `0 0 ${size} ${tall}`, class: 'skeleton', tabindex: 0,
                             role: 'img', 'aria-label': 'the robot; arrow keys turn it'});
    // Seen from where it is widest.
    const width = (angle) => {
      const a = all.map((p) => Math.cos(angle) * p[0] - Math.sin(angle) * p[1]);
      return Math.max(...a) - Math.min(...a);
    };
    let turn = 0, tilt = 0.35;
    for (let angle = 0; angle < Math.PI; angle += .1) {
      if (width(angle) > width(turn)) turn = angle;
    }
    const middle = [0, 1, 2].map((k) => (Math.max(...all.map((p) => p[k])) +
                                         Math.min(...all.map((p) => p[k]))) / 2);
    const reach = Math.max(1e-6, ...all.map((p) => Math.hypot(...p.map((x, k) => x - middle[k]))));
    const project = (p) => {
      const [x, y, z] = p.map((v, k) => (v - middle[k]) / reach);
      const a = Math.cos(turn) * x - Math.sin(turn) * y;
      const b = Math.sin(turn) * x + Math.cos(turn) * y;
      return [size / 2 + 150 * a,
              tall / 2 - 150 * (Math.cos(tilt) * z + Math.sin(tilt) * b)];
    };
    const lines = (chain) => {
      const at = chain.points.map(project);
      const before = chain.points.length > 2 && charts.before ? charts.before : at.map((p, k) => k - 1);
      return at.flatMap((p, k) => {
        if (k === 0 || before[k] < 0) return [];
        const share = chain.shares ? chain.shares[Math.min(k - 1, chain.shares.length - 1)] : null;
        const colour = `var(--${chain.colour || 'c1'})`;
        return svg('path', {d: `M${at[before[k]]}L${p}`, 'stroke-dasharray': chain.dash,
          style: `stroke: ${share === null ? colour
              : `color-mix(in srgb, var(--c2) ${Math.round(100 * share)}%, var(--line))`};` +
              `stroke-width: ${chain.width || 11}; stroke-linecap: ${chain.dash ? 'butt' : 'round'};` +
              `opacity: ${chain.opacity || 1}`});
      });
    };
    // Where joints lie on each other, their names stand side by side.
    const labels = () => {
      const placed = [];
      chains[0].points.slice(0, -1).map(project).forEach(([x, y], k) => {
        const near = placed.find((p) => Math.hypot(p.x - x, p.y - y) < 20);
        if (near) near.names.push(names[k]);
        else placed.push({x, y, names: [names[k]]});
      });
      return placed.flatMap((p) => {
        const right = p.x < size * .7;
        return [svg('circle', {cx: p.x, cy: p.y, r: 5, style: 'fill: var(--ink)'}),
                svg('text', {x: p.x + (right ? 10 : -10), y: p.y - 8, 'text-anchor': right ? 'start' : 'end',
                             class: 'halo'}, [p.names.map((n) => shortened(n, 18)).join(', '),
                                              svg('title', {}, p.names.join(', '))])];
      });
    };
    const draw = () => view.replaceChildren(...chains.flatMap(lines), ...labels());
    let held = null;
    view.addEventListener('pointerdown', (e) => {
      held = [e.clientX, e.clientY];
      view.setPointerCapture(e.pointerId);
    });
    for (const end of ['pointerup', 'pointercancel']) {
      view.addEventListener(end, () => { held = null; });
    }
    view.addEventListener('pointermove', (e) => {
      if (!held) return;
      turn += (e.clientX - held[0]) / 120;
      tilt += (e.clientY - held[1]) / 120;
      held = [e.clientX, e.clientY];
      draw();
    });
    view.addEventListener('keydown', (e) => {
      const step = {ArrowLeft: [-.15, 0], ArrowRight: [.15, 0],
                    ArrowUp: [0, -.15], ArrowDown: [0, .15]}[e.key];
      if (!step) return;
      e.preventDefault();
      turn += step[0];
      tilt += step[1];
      draw();
    });
    draw();
    return view;
  };

  return {html, svg, number, isNumber, shortened, styleOf, legend, table, bars, interval, beyond,
          profile, correlations, strongest, skeleton, percent, plusMinus, note, heading, list};
})();
