/* Draws the figures from their JSON, in the colours of the page, and links them. */
(async () => {
  const text = id => document.getElementById(id).textContent;
  const packed = Uint8Array.from(atob(text('plotly')), c => c.charCodeAt(0));
  const unpacked = new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'));
  const script = document.createElement('script');
  script.textContent = await new Response(unpacked).text();
  document.head.append(script);

  const dark = matchMedia('(prefers-color-scheme: dark)'), darker = JSON.parse(text('dark'));
  const config = {responsive: true, displaylogo: false, plotlyServerURL: '',
                  modeBarButtons: [['zoom2d', 'pan2d', 'resetScale2d', 'toImage']]};
  const plain = {...config, displayModeBar: false};  // its legend stands where the buttons would
  const boxes = [...document.querySelectorAll('.plot')];

  function made(box) {
    let json = text(box.dataset.figure);
    if (dark.matches && !printing) json = json.replace(/#[0-9a-f]{6}/g, c => darker[c] ?? c);
    const drawn = JSON.parse(json);
    for (const line of drawn.data)
      for (const key of ['x', 'y', 'customdata']) if (Number.isInteger(line[key])) line[key] = drawn.arrays[line[key]];
    if (box.dataset.zoom !== undefined) {
      for (const [key, range] of Object.entries(drawn.zoom)) drawn.layout[key.split('.')[0]].range = range;
      drawn.layout.shapes = [];
      drawn.layout.showlegend = false;  // the whole recording beside it has it
    }
    if (printing) drawn.layout.width = box.clientWidth;  // paper does not resize what is drawn
    if (box.clientWidth < 480) {
      drawn.layout.margin = {...drawn.layout.margin, l: 54, r: 6};
      drawn.layout.font.size = 11;
    }
    return drawn;
  }
  let printing = false;
  const draw = box => { const f = made(box); return Plotly.react(box, f.data, f.layout, f.layout.showlegend === false ? config : plain); };
  const drawAll = () => Promise.all(boxes.map(draw));

  /* A click on a point of the map leads to the instant at which it was measured. */
  function go(recording, at) {
    const box = boxes.find(b => b.dataset.recording === recording && b.dataset.zoom !== undefined);
    if (!box) return;
    const drawn = made(box), [a, b] = drawn.zoom['xaxis.range'], half = (b - a) / 2;
    const scale = Number(box.dataset.scale), change = {};
    for (const key of Object.keys(drawn.layout)) if (/^yaxis/.test(key)) change[key + '.autorange'] = true;
    Plotly.relayout(box, {...change, 'xaxis.range': [at * scale - half, at * scale + half]});
    box.closest('figure').scrollIntoView({block: 'center'});
    box.closest('figure').querySelector('.at').textContent = `${recording}, around ${at.toPrecision(4)} s`;
  }

  await drawAll();
  for (const box of boxes) {
    box.on('plotly_click', event => {
      const point = event.points.find(p => p.data.meta !== undefined);
      if (point) go(point.data.meta, point.customdata);
    });
    /* The whole recording and its close-up: what is selected in the first is what the second shows. */
    if (box.dataset.recording && box.dataset.zoom === undefined)
      box.on('plotly_relayout', event => {
        const close = boxes.find(b => b.dataset.figure === box.dataset.figure && b.dataset.zoom !== undefined);
        const range = event['xaxis.range'] ?? [event['xaxis.range[0]'], event['xaxis.range[1]']];
        if (close && range[0] !== undefined) Plotly.relayout(close, {'xaxis.range': range});
      });
  }
  dark.addEventListener('change', drawAll);
  const print = begins => () => {
    printing = begins;
    document.documentElement.classList.toggle('printing', begins);  // as wide as the page that is scaled to the paper
    drawAll();
  };
  addEventListener('beforeprint', print(true));
  addEventListener('afterprint', print(false));
  document.documentElement.dataset.drawn = boxes.length;
})();
