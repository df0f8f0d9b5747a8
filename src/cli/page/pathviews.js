/** @typedef {import("./series.js").Series} Series */
/** @typedef {import("./series.js").SeriesGroup} SeriesGroup */
/** @typedef {import("./series.js").SeriesAxis} SeriesAxis */

/**
 * A way to look at a group's motion as a plane.
 * @typedef {object} PathView
 * @property {string} label
 * @property {SeriesGroup} group
 * @property {SeriesAxis[]} axes whose errors are seen
 * @property {boolean} trueAspect both directions have one scale
 * @property {[string, string] | null} captions of the horizontal and the vertical direction; none in space
 * @property {(positions: Float64Array[], times: Float64Array) => [Float64Array, Float64Array]} project
 *   positions of the group's axes to horizontal and vertical coordinates
 */

/**
 * Returns all views of a series: of each group its planes, its space, and each axis over time.
 * @param {Series} series
 * @returns {PathView[]}
 */
export function pathViews(series) {
  const ways = series.groups.flatMap((group) => [...planesOf(group), ...spaceOf(group)]);
  return [...ways, ...series.groups.flatMap(overTime)];
}

/**
 * Returns commanded positions of a group with the error multiplied: `factor` 0 is the commanded
 * path, 1 the actual one.
 * @param {SeriesGroup} group
 * @param {number} factor
 */
export function displaced(group, factor) {
  return group.axes.map(({ commanded, actual }) => {
    if (factor === 0) return commanded;
    if (factor === 1) return actual;
    return commanded.map((value, row) => value + factor * (actual[row] - value));
  });
}

/**
 * Returns the largest error of some axes, without its sign.
 * @param {SeriesAxis[]} axes
 */
export function largestError(axes) {
  let largest = 0;
  for (const { error } of axes) {
    for (let row = 0; row < error.length; row += 1) {
      if (Math.abs(error[row]) > largest) largest = Math.abs(error[row]);
    }
  }
  return largest;
}

/**
 * Directions of the axes of space in the isometric view: X to the right and down, Y to the right
 * and up, Z up.
 */
export const ISOMETRIC = [
  [Math.SQRT1_2, -1 / Math.sqrt(6)],
  [Math.SQRT1_2, 1 / Math.sqrt(6)],
  [0, 2 / Math.sqrt(6)],
];

/** @param {SeriesAxis} axis */
function caption(axis) {
  return `${axis.name} (${axis.unit})`;
}

/**
 * @param {SeriesGroup} group
 * @returns {PathView[]}
 */
function planesOf(group) {
  const pairs = [[0, 1], [0, 2], [1, 2]].filter((pair) => pair.every((k) => k < group.axes.length));
  return pairs.map(([right, up]) => {
    const axes = [group.axes[right], group.axes[up]];
    return {
      label: `Plane ${axes[0].name}, ${axes[1].name}`,
      group,
      axes,
      trueAspect: true,
      captions: [caption(axes[0]), caption(axes[1])],
      project: (positions) => [positions[right], positions[up]],
    };
  });
}

/**
 * @param {SeriesGroup} group
 * @returns {PathView[]}
 */
function spaceOf(group) {
  if (group.axes.length !== 3) return [];
  const names = group.axes.map((axis) => axis.name).join(", ");
  /** @type {PathView["project"]} */
  const project = (positions) => {
    const turned = [0, 1].map((to) => {
      const coordinates = new Float64Array(positions[0].length);
      for (let row = 0; row < coordinates.length; row += 1) {
        for (let k = 0; k < 3; k += 1) coordinates[row] += ISOMETRIC[k][to] * positions[k][row];
      }
      return coordinates;
    });
    return [turned[0], turned[1]];
  };
  return [{ label: `Isometric ${names}`, group, axes: group.axes, trueAspect: true, captions: null, project }];
}

/**
 * @param {SeriesGroup} group
 * @returns {PathView[]}
 */
function overTime(group) {
  return group.axes.map((axis, k) => ({
    label: `${axis.name} over time`,
    group,
    axes: [axis],
    trueAspect: false,
    captions: ["time (s)", caption(axis)],
    project: (positions, times) => [times, positions[k]],
  }));
}
