// A small picture of the readings before the fit. Defines curvePicture(curves).
function curvePicture(curves) {
  const kWidth = 560, kHeight = 340;
  const kLeft = 58, kRight = 12, kTop = 12, kBottom = 42;
  const kColours = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9'];
  const make = (tag, attributes, text) => {
    const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
    for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
    if (text !== undefined) element.textContent = text;
    return element;
  };

  // About `count` round numbers from low to high.
  function ticks(low, high, count) {
    const rough = (high - low) / count;
    const power = 10 ** Math.floor(Math.log10(rough));
    const step = power * [1, 2, 5, 10].find((factor) => factor * power >= rough);
    const all = [];
    for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) all.push(i * step);
    return all;
  }

  function span(values) {
    let [low, high] = [0, 0];
    for (const value of values) {
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
    if (low === high) high = low + 1;
    const air = 0.03 * (high - low);
    return [low < 0 ? low - air : low, high + air];
  }

  const [low_V, high_V] = span(curves.flatMap((curve) => curve.voltage_V));
  const [low_A, high_A] = span(curves.flatMap((curve) => curve.current_A));
  const x = (volt) => kLeft + (kWidth - kLeft - kRight) * (volt - low_V) / (high_V - low_V);
  const y = (ampere) => kHeight - kBottom - (kHeight - kTop - kBottom) * (ampere - low_A) / (high_A - low_A);
  const number = (value) => String(Number(value.toPrecision(6)));
  const readings = curves.reduce((sum, curve) => sum + curve.readings, 0);
  const svg = make('svg', {viewBox: `0 0 ${kWidth} ${kHeight}`, role: 'img', 'aria-label':
      `${readings} readings from ${number(Math.min(...curves.flatMap((curve) => curve.voltage_V)))} to ` +
      `${number(Math.max(...curves.flatMap((curve) => curve.voltage_V)))} volt`});
  for (const volt of ticks(low_V, high_V, 6)) {
    svg.append(make('line', {class: 'grid', x1: x(volt), x2: x(volt), y1: kTop, y2: kHeight - kBottom}));
    svg.append(make('text', {x: x(volt), y: kHeight - kBottom + 17, 'text-anchor': 'middle'}, number(volt)));
  }
  for (const ampere of ticks(low_A, high_A, 5)) {
    svg.append(make('line', {class: 'grid', x1: kLeft, x2: kWidth - kRight, y1: y(ampere), y2: y(ampere)}));
    svg.append(make('text', {x: kLeft - 7, y: y(ampere) + 4, 'text-anchor': 'end'}, number(ampere)));
  }
  svg.append(make('line', {class: 'axis', x1: x(0), x2: x(0), y1: kTop, y2: kHeight - kBottom}));
  svg.append(make('line', {class: 'axis', x1: kLeft, x2: kWidth - kRight, y1: y(0), y2: y(0)}));
  svg.append(make('text', {x: (kLeft + kWidth - kRight) / 2, y: kHeight - 6, 'text-anchor': 'middle'}, 'voltage (V)'));
  svg.append(make('text', {x: 0, y: 0, 'text-anchor': 'middle',
                           transform: `translate(13 ${(kTop + kHeight - kBottom) / 2}) rotate(-90)`}, 'current (A)'));
  curves.forEach((curve, i) => {
    const colour = `var(--c-${kColours[i % kColours.length].slice(1)}, ${kColours[i % kColours.length]})`;
    const places = curve.voltage_V.map((volt, k) => [x(volt).toFixed(1), y(curve.current_A[k]).toFixed(1)]);
    svg.append(make('path', {class: 'curve', style: `stroke:${colour}`, opacity: 0.5, d: `M${places.join('L')}`}));
    if (places.length > 400) return;
    const dots = places.map(([cx, cy]) => `M${cx} ${cy}h0`).join('');
    svg.append(make('path', {d: dots, style: `stroke:${colour}`, 'stroke-width': places.length > 100 ? 3.5 : 5,
                             'stroke-linecap': 'round'}));
  });
  return svg;
}
