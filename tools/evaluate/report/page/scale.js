// From values to pixels of an axis, and the values worth naming on it.

function niceStep(span, count) {
  const rough = span / count, power = 10 ** Math.floor(Math.log10(rough));
  return power * [1, 2, 2.5, 5, 10].find((factor) => factor * power >= rough * 0.999);
}

function linearTicks(low, high, count) {
  const step = niceStep(high - low, count), ticks = [];
  for (let i = Math.ceil(low / step); i * step <= high; ++i) ticks.push({ value: i * step, named: true });
  return ticks;
}

// Decades; what lies between them gets names too where there is room.
function logTicks(low, high, count) {
  const room = count / Math.log10(high / low);  // names a decade
  const named = room > 14 ? [1, 1.5, 2, 2.5, 3, 4, 5, 6, 7, 8, 9] : room > 3.5 ? [1, 2, 5] : [1];
  const every = Math.max(1, Math.ceil(1 / room)), ticks = [];
  for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high); ++power)
    for (const factor of [1, 1.5, 2, 2.5, 3, 4, 5, 6, 7, 8, 9]) {
      const value = factor * 10 ** power, isNamed = named.includes(factor) && (factor > 1 || power % every === 0);
      if (value >= low && value <= high && (isNamed || Number.isInteger(factor))) ticks.push({ value, named: isNamed });
    }
  return ticks;
}

const gutter = 30;  // pixels at the start of a logarithmic axis, for what is 0

// from, to: pixels; room: what a name takes of them. A logarithmic axis of values without any above 0 becomes linear.
function makeScale(values, log, from, to, room) {
  const count = Math.max(2, Math.abs(to - from) / room);
  const positive = values.filter((value) => value > 0);
  if (log && positive.length) {
    const zero = positive.length < values.length, start = zero ? from + Math.sign(to - from) * gutter : from;
    let low = Math.min(...positive), high = Math.max(...positive);
    const border = Math.max(1.15, (high / low) ** 0.06);
    low /= border;
    high *= border;
    const at = (value) => value > 0 ? start + (to - start) * Math.log(value / low) / Math.log(high / low)
      : from + Math.sign(to - from) * gutter * 0.35;
    return { at, zero, start, ticks: logTicks(low, high, count) };
  }
  let low = Math.min(...values), high = Math.max(...values);
  const border = high > low ? (high - low) * 0.06 : Math.abs(high) * 0.1 || 1;
  low = low >= 0 && low < border * 4 ? 0 : low - border;
  high += border;
  return { at: (value) => from + (to - from) * (value - low) / (high - low), zero: false, start: from,
    ticks: linearTicks(low, high, count) };
}
