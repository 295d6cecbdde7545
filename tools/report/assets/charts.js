'use strict';
// Drawings that need no library: elements, bars, intervals, a heat map and a
// robot's skeleton. Text goes in through textContent only.
const charts = (() => {
  const kSvg = 'http://www.w3.org/2000/svg';

  const put = (node, attributes, children) => {
    for (const [name, value] of Object.entries(attributes || {})) {
      if (value === undefined || value === null) continue;
      node.setAttribute(name, value);
    }
    for (const child of [].concat(children === undefined ? [] : children)) {
      if (child === null || child === undefined) continue;
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
    return size >= 1e5 || size < 1e-3 ? x.toExponential(2)
                                      : String(Number(x.toPrecision(4)));
  };

  // rows: [[cell]]; a cell is a text, a number or a node.
  const table = (titles, rows, long) => {
    const cell = (tag, value) => html(
        tag, {class: isNumber(value) ? 'number' : null,
              scope: tag === 'th' ? 'col' : null},
        isNumber(value) ? number(value) : value);
    const body = rows.map((row) => html('tr', {}, row.map((x) => cell('td', x))));
    return html('div', {class: long ? 'scroll long' : 'scroll',
                        tabindex: long ? 0 : null},
                html('table', {}, [
                  html('thead', {}, html('tr', {}, titles.map((t) => cell('th', t)))),
                  html('tbody', {}, body)]));
  };

  // rows: [{label, value, low, high, colour, note}]; interval optional.
  const bars = (rows, unit, options = {}) => {
    const left = 190, right = 90, width = 760, height = 26;
    const shown = rows.filter((r) => isNumber(r.value));
    if (shown.length === 0) return null;
    const top = Math.max(...shown.map((r) => Math.max(r.value, r.high || 0)), 1e-300);
    const log = options.log && Math.min(...shown.map((r) => r.value)) > 0 &&
        top / Math.min(...shown.map((r) => r.value)) > 50;
    const least = log ? Math.min(...shown.map((r) => r.value)) / 2 : 0;
    const x = (value) => {
      const share = log ? Math.log(Math.max(value, least) / least) / Math.log(top / least)
                        : Math.max(0, value) / top;
      return left + share * (width - left - right);
    };
    const parts = [];
    shown.forEach((r, k) => {
      const y = k * height + 4;
      parts.push(svg('text', {x: left - 8, y: y + 13, 'text-anchor': 'end'}, r.label));
      parts.push(svg('rect', {x: left, y, height: 17, width: Math.max(1, x(r.value) - left),
                              style: `fill: var(--${r.colour || 'c1'})`}));
      if (isNumber(r.low) && isNumber(r.high)) {
        parts.push(svg('path', {
          d: `M${x(r.low)} ${y + 8.5}H${x(r.high)}M${x(r.low)} ${y + 4}v9M${x(r.high)} ${y + 4}v9`,
          style: 'stroke: var(--ink); stroke-width: 1.5; fill: none'}));
      }
      const end = isNumber(r.high) ? Math.max(x(r.high), x(r.value)) : x(r.value);
      parts.push(svg('text', {x: end + 6, y: y + 13},
                     r.note || number(r.value) + (unit ? ' ' + unit : '')));
    });
    return svg('svg', {viewBox: `0 0 ${width} ${shown.length * height + 4}`, width: '100%',
                       role: 'img', 'aria-label': options.title || 'bars'}, parts);
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

  // values: rows of numbers from -1 to 1; blue to orange through the paper.
  const correlations = (names, values) => {
    const canvas = html('canvas', {role: 'img', 'aria-label': 'correlations',
                                   tabindex: 0});
    const size = names.length, cell = Math.max(3, Math.min(18, Math.floor(760 / size)));
    canvas.width = canvas.height = cell * size;
    const draw = canvas.getContext('2d');
    values.forEach((row, r) => row.forEach((v, c) => {
      const share = isNumber(v) ? Math.min(1, Math.abs(v)) : 0;
      draw.fillStyle = !isNumber(v) ? 'rgba(128,128,128,.25)'
          : v > 0 ? `rgba(213,94,0,${share})` : `rgba(0,114,178,${share})`;
      draw.fillRect(c * cell, r * cell, cell, cell);
    }));
    const said = html('p', {class: 'faint', 'aria-live': 'polite'},
                      'Point at a cell to read it.');
    canvas.addEventListener('mousemove', (event) => {
      const box = canvas.getBoundingClientRect();
      const at = (x, side) => Math.min(size - 1, Math.max(0, Math.floor(size * x / side)));
      const c = at(event.clientX - box.left, box.width);
      const r = at(event.clientY - box.top, box.height);
      said.textContent = `${names[r]} and ${names[c]}: ${number(values[r][c])}`;
    });
    return html('div', {}, [html('div', {class: 'scroll'}, canvas), said]);
  };

  // points: [[x, y, z]]; shares: per segment 0 to 1, or null. Turned with the
  // mouse or the arrow keys.
  const skeleton = (points, names, shares) => {
    const size = 420;
    const view = svg('svg', {viewBox: `0 0 ${size} ${size}`, width: size, height: size,
                             class: 'skeleton', tabindex: 0, role: 'img',
                             'aria-label': 'the robot; arrow keys turn it'});
    // Seen from where it is widest.
    const width = (angle) => {
      const a = points.map((p) => Math.cos(angle) * p[0] - Math.sin(angle) * p[1]);
      return Math.max(...a) - Math.min(...a);
    };
    let turn = 0, tilt = 0.35;
    for (let angle = 0; angle < Math.PI; angle += .1) {
      if (width(angle) > width(turn)) turn = angle;
    }
    const middle = [0, 1, 2].map((k) => (Math.max(...points.map((p) => p[k])) +
                                         Math.min(...points.map((p) => p[k]))) / 2);
    const reach = Math.max(1e-6, ...points.map((p) => Math.hypot(...p.map((x, k) => x - middle[k]))));
    const project = (p) => {
      const [x, y, z] = p.map((v, k) => (v - middle[k]) / reach);
      const a = Math.cos(turn) * x - Math.sin(turn) * y;
      const b = Math.sin(turn) * x + Math.cos(turn) * y;
      return [size / 2 + 180 * a,
              size / 2 - 180 * (Math.cos(tilt) * z + Math.sin(tilt) * b)];
    };
    const draw = () => {
      const at = points.map(project), parts = [];
      for (let k = 0; k + 1 < at.length; ++k) {
        const share = shares ? shares[Math.min(k, shares.length - 1)] : null;
        parts.push(svg('path', {d: `M${at[k]}L${at[k + 1]}`,
          style: `stroke: ${share === null ? 'var(--c1)'
              : `color-mix(in srgb, var(--c2) ${Math.round(100 * share)}%, var(--line))`};` +
              'stroke-width: 11; stroke-linecap: round'}));
      }
      at.slice(0, -1).forEach(([x, y], k) => {
        parts.push(svg('circle', {cx: x, cy: y, r: 6, style: 'fill: var(--ink)'}));
        parts.push(svg('text', {x: x + 10, y: y - 8}, names[k]));
      });
      view.replaceChildren(...parts);
    };
    let held = null;
    view.addEventListener('pointerdown', (e) => {
      held = [e.clientX, e.clientY];
      view.setPointerCapture(e.pointerId);
    });
    view.addEventListener('pointerup', () => { held = null; });
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

  return {html, svg, number, isNumber, table, bars, interval, correlations, skeleton};
})();
