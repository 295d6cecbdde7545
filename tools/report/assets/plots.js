'use strict';
// Plots that zoom, by dygraphs: drawn when they come into sight, those of a
// group always over the same stretch, read and zoomed with the keyboard, too.
const plots = (() => {
  const {html, number, styleOf} = charts;
  const all = [];

  const inkOf = (name) =>
      getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim();

  const group = () => ({members: [], range: null, spreading: false});

  // All of a group over the range of one of them.
  const spread = (from) => {
    const shared = from.group;
    if (!shared || shared.spreading) return;
    shared.spreading = true;
    shared.range = from.chart.isZoomed('x') ? from.chart.xAxisRange() : null;
    for (const plot of shared.members) {
      if (plot === from || !plot.chart) continue;
      if (plot.seen) plot.chart.updateOptions({dateWindow: shared.range});
      else plot.late = true;
    }
    shared.spreading = false;
  };

  const optionsOf = (plot) => {
    const styles = plot.labels.slice(1).map(styleOf);
    const series = {};
    plot.labels.slice(1).forEach((label, k) => {
      series[label] = {strokePattern: styles[k].dash};
      if (styles[k].width) series[label].strokeWidth = styles[k].width;
    });
    return Object.assign({
      labels: plot.labels, series, legend: 'follow', strokeWidth: 1.5, fillAlpha: .25,
      colors: styles.map(({colour}) => inkOf(colour)), axisLineColor: inkOf('faint'),
      gridLineColor: 'rgba(128,128,128,.22)', labelsKMB: false, digitsAfterDecimal: 4,
      highlightCircleSize: 3, xRangePad: 2, dateWindow: plot.group && plot.group.range,
      axes: {y: {valueFormatter: number, axisLabelFormatter: number, axisLabelWidth: 58, pixelsPerLabel: 24}, x: {valueFormatter: (x) =>
          `${number(x)} ${plot.labels[0]}`}},
      drawCallback: (chart, first) => { if (!first && plot.chart) spread(plot); }}, plot.options);
  };

  const draw = (plot, sharpness) => {
    if (plot.chart) plot.chart.destroy();
    plot.chart = null;
    plot.chart = new Dygraph(plot.place, plot.values(),
                             Object.assign(optionsOf(plot), {pixelRatio: sharpness || null}));
    plot.late = false;
  };

  const watch = new IntersectionObserver((entries) => {
    for (const entry of entries) {
      const plot = all.find((p) => p.place === entry.target);
      if (!plot) continue;
      plot.seen = entry.isIntersecting;
      if (!plot.seen) continue;
      if (!plot.chart) draw(plot);
      else if (plot.late) {
        plot.late = false;
        plot.group.spreading = true;
        plot.chart.updateOptions({dateWindow: plot.group.range});
        plot.group.spreading = false;
      }
    }
  }, {rootMargin: '300px'});

  // Left and right read, + and - zoom, shift moves, Home shows all.
  const onKey = (plot, event) => {
    const chart = plot.chart;
    if (!chart) return;
    const [low, high] = chart.xAxisRange(), span = high - low;
    const rows = chart.numRows();
    const window = (a, b) => chart.updateOptions({dateWindow: [a, b]});
    const read = (step) => {
      let row = chart.getSelection();
      if (row < 0) {
        row = 0;
        while (row < rows - 1 && chart.getValue(row, 0) < low + span / 2) ++row;
      } else {
        row = Math.max(0, Math.min(rows - 1, row + step * Math.max(1, Math.round(rows / 400))));
      }
      chart.setSelection(row);
      const said = plot.labels.slice(1).map((label, k) => {
        const value = chart.getValue(row, k + 1);
        return `${label} ${number(Array.isArray(value) ? value[1] : value)}`;
      });
      plot.said.textContent = `${number(chart.getValue(row, 0))} ${plot.labels[0]}: ${said.join(', ')}`;
    };
    const row = chart.getSelection();
    const middle = row >= 0 ? chart.getValue(row, 0) : low + span / 2;
    const act = {
      ArrowLeft: () => event.shiftKey ? window(low - span / 4, high - span / 4) : read(-1),
      ArrowRight: () => event.shiftKey ? window(low + span / 4, high + span / 4) : read(1),
      '+': () => window(middle - span / 4, middle + span / 4),
      '-': () => window(middle - span, middle + span),
      Home: () => chart.resetZoom(), Escape: () => chart.clearSelection()};
    act['='] = act['+'];
    if (!act[event.key]) return;
    event.preventDefault();
    act[event.key]();
  };

  // values: a function that gives dygraphs' rows; labels: [of x, of each line].
  const add = (title, values, labels, options = {}, shared = null, kind = '') => {
    const place = html('div', {class: 'plot ' + kind, tabindex: 0, role: 'group',
      'aria-label': title + '; arrow keys read values, plus and minus zoom, Home shows all'});
    const said = html('p', {class: 'said', 'aria-live': 'polite'});
    const plot = {place, said, values, labels, options, group: shared, chart: null, seen: false, late: false};
    place.addEventListener('keydown', (event) => onKey(plot, event));
    if (shared) shared.members.push(plot);
    all.push(plot);
    watch.observe(place);
    return html('div', {}, [html('h3', {}, title), place, said]);
  };

  // Distances above 0 on a logarithm's scale, a row each: [x, before, after].
  // Hollow squares before, dots after, so that neither hides the other.
  const dots = (title, rows, labels) => {
    const positive = rows.flatMap((row) => row.slice(1)).filter((d) => d > 0);
    return add(title, () => rows, labels,
      {logscale: true, strokeWidth: 0, drawPoints: true, pointSize: 3,
       valueRange: [Math.min(...positive) / 2, 2 * Math.max(...positive)],
       drawPointCallback: (g, name, pen, x, y, colour, size) => {
         pen.beginPath();
         pen.setLineDash([]);
         pen.lineWidth = 1.5;
         pen.strokeStyle = pen.fillStyle = colour;
         if (name === labels[2]) pen.arc(x, y, size, 0, 2 * Math.PI), pen.fill();
         else pen.rect(x - size, y - size, 2 * size, 2 * size), pen.stroke();
       }});
  };

  // Those inside an element that goes.
  const forget = (element) => {
    for (let k = all.length - 1; k >= 0; --k) {
      if (!element.contains(all[k].place)) continue;
      watch.unobserve(all[k].place);
      if (all[k].chart) all[k].chart.destroy();
      all.splice(k, 1);
    }
  };

  // After the colours or the width have changed.
  const redraw = () => {
    for (const plot of all) if (plot.chart) draw(plot);
    for (const canvas of document.querySelectorAll('canvas')) {
      if (canvas.redraw) canvas.redraw();
    }
  };

  // For paper, where canvases may stay blank: all as pictures, drawn sharply.
  const kPaper = 3;
  const print = () => {
    for (const plot of all) {
      draw(plot, kPaper);
      for (const canvas of plot.place.querySelectorAll('canvas')) {
        canvas.replaceWith(html('img', {src: canvas.toDataURL(), style: canvas.style.cssText, alt: ''}));
      }
    }
  };

  return {add, dots, forget, group, redraw, print, all};
})();
