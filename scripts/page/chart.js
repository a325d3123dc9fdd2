"use strict";
// Charts as SVG, from the series that s.chart takes. draw(figure, chart, pick) draws into the
// element `figure` and again when its width changes; pick(clip) is called for a point with a clip.

const chartView = (() => {
  const colours = ["blue", "orange", "green", "pink", "amber", "sky", "grey"];
  const symbols = ["disc", "square", "triangle", "diamond", "triangle_down", "pentagon"];
  const radius = 4.5; // of a symbol in text of 12 px

  // ---- Axes -------------------------------------------------------------------------------------

  // Plain from `low` to below `high`, with a power of ten beyond.
  function format(value, low = 1e-3, high = 1e5) {
    const size = Math.abs(value);
    if (size === 0 || (size >= low && size < high)) return String(Number(value.toPrecision(4)));
    const power = Math.floor(Math.log10(size) + 1e-9);
    const digits = String(power).replace("-", "⁻").replace(/\d/g, (d) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[d]);
    const mantissa = Number((value / 10 ** power).toPrecision(3));
    return (mantissa === 1 ? "" : mantissa + "·") + "10" + digits;
  }

  // Log axes are as in the charts of s.chart: power_text in report/chart_layout.cpp.
  const tickText = (value, log) => log ? format(value, 0.01, 1e3) : format(value);

  // Whole multiples of 1, 2 or 5 times a power of ten.
  function linearTicks(low, high, most) {
    const raw = (high - low) / Math.max(1, most);
    const power = 10 ** Math.floor(Math.log10(raw));
    const step = power * [1, 2, 5, 10].find((factor) => factor * power >= raw * (1 - 1e-9));
    const ticks = [];
    for (let k = Math.ceil(low / step - 1e-9); k * step <= high * (1 + 1e-12) + 1e-9 * step; ++k)
      ticks.push(Number((k * step).toPrecision(12)));
    return ticks;
  }

  // Powers of ten, with 2 and 5 times them where there is room.
  function logTicks(low, high, most) {
    const from = Math.floor(Math.log10(low)), to = Math.ceil(Math.log10(high));
    const inside = (v) => v >= low * (1 - 1e-9) && v <= high * (1 + 1e-9);
    for (const factors of [[1, 2, 5], [1, 3], [1]]) {
      const ticks = [];
      for (let p = from; p <= to; ++p)
        for (const factor of factors) ticks.push(Number((factor * 10 ** p).toPrecision(12)));
      const seen = ticks.filter(inside);
      if (seen.length <= most || factors.length === 1) {
        const every = Math.ceil(seen.length / most);
        return seen.filter((_, i) => i % every === 0);
      }
    }
    return [];
  }

  // {low, high, log, ticks, at(value)}: at maps to 0..1.
  function axis(values, {log, from, most}) {
    const usable = values.filter((v) => Number.isFinite(v) && (!log || v > 0));
    let low = usable.length ? Math.min(...usable) : 1;
    let high = usable.length ? Math.max(...usable) : log ? 10 : 2;
    if (log) {
      const room = Math.max(0.06 * Math.log10(high / low), 0.08);
      low /= 10 ** room;
      high *= 10 ** room;
    } else {
      const room = 0.06 * ((high - low) || Math.abs(high) || 1);
      const zero = low >= 0 && low <= 0.4 * high; // an axis that nearly reaches 0 begins there
      low = zero ? 0 : low - room;
      high += room;
    }
    if (from !== undefined && from > 0 && from < high) low = from;
    const ticks = log ? logTicks(low, high, most) : linearTicks(low, high, most);
    const of = log ? Math.log10 : Number;
    return {low, high, log, ticks, at: (v) => (of(v) - of(low)) / (of(high) - of(low))};
  }

  // ---- Labels -----------------------------------------------------------------------------------

  const overlaps = (a, b) => a.x < b.x + b.w && b.x < a.x + a.w && a.y < b.y + b.h &&
    b.y < a.y + a.h;

  // Whether a line from (x1, y1) to (x2, y2) crosses a box, by clipping it at the four sides.
  function crosses(box, [x1, y1, x2, y2]) {
    let from = 0, to = 1;
    for (const [start, step, low, high] of [[x1, x2 - x1, box.x, box.x + box.w],
      [y1, y2 - y1, box.y, box.y + box.h]]) {
      if (step === 0) {
        if (start < low || start > high) return false;
        continue;
      }
      const a = (low - start) / step, b = (high - start) / step;
      from = Math.max(from, Math.min(a, b));
      to = Math.min(to, Math.max(a, b));
    }
    return from <= to;
  }

  // A place beside each point for its label such that no label covers a point or another label or
  // is nearer to another labelled point, and as few lines as possible are covered; none if there
  // is no such place. marks: [{x, y, label}], lines: [[x1, y1, x2, y2]]; returns [{x, y, w, h} or
  // null].
  function placeLabels(marks, lines, {width, height, size}) {
    const r = radius * size / 12;
    const taken = marks.map(({x, y}) => ({x: x - r, y: y - r, w: 2 * r, h: 2 * r}));
    const labelled = marks.filter(({label}) => label);
    return marks.map(({x, y, label}) => {
      if (!label) return null;
      const w = 0.56 * size * label.length, h = size, gap = r + 3;
      const places = [[gap, -h / 2], [-gap - w, -h / 2], [-w / 2, -gap - h], [-w / 2, gap],
        [gap, -gap - h / 2], [gap, gap - h / 2], [-gap - w, -gap - h / 2], [-gap - w, gap - h / 2]];
      let best = null, least = Infinity;
      for (const [dx, dy] of places) {
        const box = {x: x + dx, y: y + dy, w, h};
        const inside = box.x >= 0 && box.y >= 0 && box.x + w <= width && box.y + h <= height;
        if (!inside || taken.some((other) => overlaps(box, other))) continue;
        const [own, ...others] = [{x, y}, ...labelled].map((p) =>
          Math.hypot(Math.max(box.x - p.x, p.x - box.x - w, 0),
                     Math.max(box.y - p.y, p.y - box.y - h, 0)));
        if (Math.min(...others) < own) continue;
        const crossed = lines.filter((line) => crosses(box, line)).length;
        if (crossed >= least) continue;
        best = box;
        least = crossed;
      }
      if (best) taken.push(best);
      return best;
    });
  }

  // ---- Drawing ----------------------------------------------------------------------------------

  function svg(name, attributes = {}, parent = null, text = "") {
    const element = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    if (text) element.textContent = text;
    if (parent) parent.append(element);
    return element;
  }

  function polygonPath(corners, turn, size) {
    const points = Array.from({length: corners}, (_, i) => {
      const angle = turn + 2 * Math.PI * i / corners;
      return `${(size * Math.sin(angle)).toFixed(2)} ${(-size * Math.cos(angle)).toFixed(2)}`;
    });
    return `M${points.join("L")}Z`;
  }

  function symbolPath(symbol) {
    switch (symbol) {
      case "square": return polygonPath(4, Math.PI / 4, 1.25 * radius);
      case "triangle": return polygonPath(3, 0, 1.4 * radius);
      case "triangle_down": return polygonPath(3, Math.PI, 1.4 * radius);
      case "diamond": return polygonPath(4, 0, 1.35 * radius);
      case "pentagon": return polygonPath(5, 0, 1.25 * radius);
      default: {
        const r = symbol === "ring" ? 1.6 * radius : radius;
        return `M${-r} 0a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${-2 * r} 0Z`;
      }
    }
  }

  // Colours and symbols of series that do not choose theirs; `joined` is usual.
  function looks(series) {
    let next = 0;
    return series.map((one) => {
      const own = one.colour || one.symbol;
      const look = {
        colour: `var(--${one.colour || colours[next % colours.length]})`,
        symbol: one.symbol || (own ? "disc" : symbols[next % symbols.length]),
        joined: one.joined !== false, dashed: !!one.dashed,
      };
      if (!own) ++next;
      return look;
    });
  }

  function legend(figure, series, look) {
    const list = document.createElement("ul");
    list.className = "legend";
    series.forEach((one, i) => {
      if (!one.name || one.name.trim() === "") return;
      const item = document.createElement("li");
      const sign = svg("svg", {width: 22, height: 12, viewBox: "-11 -6 22 12",
                               "aria-hidden": "true"});
      if (look[i].joined)
        svg("path", {d: "M-11 0H11", class: "line", style: `stroke:${look[i].colour}`,
                     ...(look[i].dashed ? {"stroke-dasharray": "4 3"} : {})}, sign);
      if (look[i].symbol !== "none") drawSymbol(sign, look[i], 0, 0);
      item.append(sign, one.name);
      list.append(item);
    });
    if (list.childElementCount > 1) figure.append(list);
  }

  function drawSymbol(parent, look, x, y, scale = 1) {
    const ring = look.symbol === "ring";
    return svg("path", {d: symbolPath(look.symbol), class: ring ? "ring" : "mark",
                        transform: `translate(${x.toFixed(1)} ${y.toFixed(1)}) scale(${scale})`,
                        style: ring ? `stroke:${look.colour}` : `fill:${look.colour}`}, parent);
  }

  const ranges = (points, value, low, high) => points.flatMap((p) =>
    [p[value], p[low], p[high]].filter((v) => v !== undefined));

  function draw(figure, chart, pick) {
    const look = looks(chart.series);
    legend(figure, chart.series, look);
    const add = (className, text) => {
      const line = document.createElement("div");
      line.className = className;
      line.textContent = text;
      figure.append(line);
      return line;
    };
    add("axis-label", chart.y_label);
    const frame = add("plot", "");
    add("axis-label below", chart.x_label);
    const tip = document.createElement("div");
    tip.className = "tip";
    tip.hidden = true;
    const again = () => plot(frame, tip, chart, look, pick);
    again();
    let width = frame.clientWidth;
    new ResizeObserver(() => {
      if (Math.abs(frame.clientWidth - width) < 2) return;
      width = frame.clientWidth;
      again();
    }).observe(frame);
  }

  function plot(frame, tip, chart, look, pick) {
    const width = Math.max(220, frame.clientWidth);
    const size = parseFloat(getComputedStyle(frame).fontSize); // of texts [px]
    const height = Math.round(Math.min(560, Math.max(240, 0.56 * width)));
    const all = chart.series.flatMap((one) => one.points);
    const y = axis(ranges(all, "y", "low", "high"), {log: chart.log_y, from: chart.y_from,
                                                    most: Math.max(3, height / (4.5 * size))});
    const longest = Math.max(...y.ticks.map((v) => tickText(v, y.log).length), 1);
    const margin = {left: size * (0.8 + 0.6 * longest),
                    right: size, top: 0.8 * size, bottom: 2.1 * size};
    const w = width - margin.left - margin.right, h = height - margin.top - margin.bottom;
    const x = axis(ranges(all, "x", "x_low", "x_high"), {log: chart.log_x,
                                                        most: Math.max(3, w / (6 * size))});
    const px = (v) => w * x.at(v), py = (v) => h * (1 - y.at(Math.max(v, y.low)));
    const root = svg("svg", {width, height, viewBox: `0 0 ${width} ${height}`, role: "group",
                             "aria-label": `${chart.title}. Across: ${chart.x_label}. Up: ` +
                               chart.y_label});
    const area = svg("g", {transform: `translate(${margin.left} ${margin.top})`}, root);
    for (const v of y.ticks) {
      svg("path", {d: `M0 ${py(v).toFixed(1)}H${w}`, class: "grid"}, area);
      svg("text", {x: -0.6 * size, y: py(v) + 0.35 * size, "text-anchor": "end", class: "tick"}, area,
          tickText(v, y.log));
    }
    for (const v of x.ticks) {
      svg("path", {d: `M${px(v).toFixed(1)} 0V${h}`, class: "grid"}, area);
      svg("text", {x: px(v), y: h + 1.45 * size, "text-anchor": "middle", class: "tick"}, area,
          tickText(v, x.log));
    }
    svg("path", {d: `M0 0V${h}H${w}`, class: "axes"}, area);
    const shown = (p) => Number.isFinite(p.x) && Number.isFinite(p.y) &&
      (!chart.log_x || p.x > 0) && (!chart.log_y || p.y > 0);
    const marks = [], lines = [];
    chart.series.forEach((one, i) => {
      const points = one.points.filter(shown);
      if (look[i].joined && points.length > 1)
        svg("path", {d: "M" + points.map((p) => `${px(p.x).toFixed(1)} ${py(p.y).toFixed(1)}`)
                       .join("L"), class: "line", style: `stroke:${look[i].colour}`,
                     ...(look[i].dashed ? {"stroke-dasharray": "5 4"} : {})}, area);
      if (look[i].joined)
        for (let k = 1; k < points.length; ++k)
          lines.push([px(points[k - 1].x), py(points[k - 1].y), px(points[k].x), py(points[k].y)]);
      for (const p of points) {
        if (p.low !== undefined && p.high !== undefined)
          bar(area, look[i], px(p.x), py(p.low), px(p.x), py(p.high));
        if (p.x_low !== undefined && p.x_high !== undefined)
          bar(area, look[i], px(Math.max(p.x_low, x.low)), py(p.y), px(p.x_high), py(p.y));
        if (look[i].symbol !== "none")
          marks.push({x: px(p.x), y: py(p.y), label: p.label, point: p, look: look[i],
                      series: one.name || ""});
      }
    });
    placeLabels(marks, lines, {width: w, height: h, size}).forEach((box, i) => {
      if (box)
        svg("text", {x: box.x, y: box.y + 0.85 * size, class: "label"}, area, marks[i].label);
    });
    for (const mark of marks) addMark(area, mark, chart, {tip, margin, width, size}, pick);
    frame.replaceChildren(root, tip);
  }

  function bar(area, look, x1, y1, x2, y2) {
    svg("path", {d: `M${x1.toFixed(1)} ${y1.toFixed(1)}L${x2.toFixed(1)} ${y2.toFixed(1)}`,
                 class: "bar", style: `stroke:${look.colour}`}, area);
  }

  function describe(mark) {
    const name = mark.point.label || mark.point.clip || mark.series;
    return `${name ? name + ": " : ""}${format(mark.point.x)} across, ${format(mark.point.y)} up`;
  }

  function addMark(area, mark, chart, {tip, margin, width, size}, pick) {
    const {clip} = mark.point;
    const plays = clip && pick.has(clip);
    const group = svg("g", plays ? {role: "button", tabindex: 0, class: "point", "data-clip": clip,
                                    "aria-label": `${describe(mark)}. Play this level.`}
                                 : {class: "point"}, area);
    svg("circle", {cx: mark.x, cy: mark.y, r: 0.9 * size, class: "target"}, group);
    drawSymbol(group, mark.look, mark.x, mark.y, size / 12);
    const show = () => {
      tip.textContent = describe(mark) + (plays ? " — click to play" : "");
      tip.hidden = false;
      const left = margin.left + mark.x, half = tip.offsetWidth / 2;
      tip.style.left = `${Math.min(Math.max(left, half), Math.max(half, width - half))}px`;
      tip.style.top = `${margin.top + mark.y - 14}px`;
    };
    const hide = () => { tip.hidden = true; };
    group.addEventListener("pointerenter", show);
    group.addEventListener("pointerleave", hide);
    group.addEventListener("focus", show);
    group.addEventListener("blur", hide);
    if (!plays) return;
    group.addEventListener("click", () => pick.play(clip));
    group.addEventListener("keydown", (event) => {
      if (event.key !== "Enter" && event.key !== " ") return;
      event.preventDefault();
      pick.play(clip);
    });
  }

  return {draw, axis, format, linearTicks, logTicks, placeLabels, tickText};
})();
