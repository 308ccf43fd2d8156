// Presets for a test, in the form in which VisualPDE has them.
let presets = {};

presets["Spots"] = {
  boundaryConditions_1: "neumann",
  boundaryConditions_2: "neumann",
  domainScale: "32",
  dt: 0.05,
  kineticParams: "F = 0.037 in [0, 0.1]; k = 0.06",
  overlayColour: 0x0000ff, // a number that JSON does not have
  spatialStep: ".5",
  simTitle: 'Spots of a "test"',
  squareCanvas: true,
  parent: null,
};

presets["Growing"] = {
  boundaryConditions_2: "dirichlet",
  crossDiffusion: true,
  diffusionStr_1_1: "0.1*(1 + x/L_x)",
  diffusionStrVV: "0.05",
  dirichletStr_2: "0.5",
  domainIndicatorFun: "x^2 + (y - L_y/2)^2 < (6 + t)^2",
  domainViaIndicatorFun: true,
  globalIntegralFun: "u",
  initCond_1: "1 + 0.5*sin(x)",
  minX: "-L_x/2",
  parent: "spots",
  reactionStr_1: "-0.1*u_x + 0.1*u_xb - 0.01*GlobalInt*u",
  reactionStr_2: "u*v^2 - (F + k)*v",
  views: [{ whatToPlot: "u + v", name: "sum" }, { name: "v" }],
};

presets["Kept"] = {
  parent: "Growing",
  minX: "0",
  numSpecies: 1,
  reactionStr_1: "0",
};

/* A drawn obstacle. */
presets["Dug"] = {
  boundaryConditions_2: "dirichlet",
  domainIndicatorFun: "w < 0.5",
  domainViaIndicatorFun: true,
  initCond_3: "ind(x < 6 && y < 4)",
  boundaryConditions_3: "dirichlet",
  diffusionStr_3_3: "0",
  dirichletStr_3: "w",
  numSpecies: 3,
  parent: "Spots",
  reactionStr_3: "0",
};

presets["Life"] = {
  automataMode: true,
  boundaryConditions_1: "periodic",
  boundaryConditions_2: "periodic",
  crossDiffusion: true,
  initCond_2: "ind(abs(x - 6) < 2 && abs(y - 5.2) < 0.4)",
  numAlgebraicSpecies: 1,
  parent: "Spots",
  reactionStr_1: "0",
  reactionStr_2: "ind(v[x+dx,y] + v[x-dx,y] + v[x,y+dy] + v[x, y-2*dy] > 1.5)",
};

presets["Painted"] = {
  initCond_1: "I_SR(x/2, y + dy) + I_T",
  initCond_2: "I_T(x, L_y - y)",
  parent: "Spots",
};

presets["Round"] = { parent: "Trip" };
presets["Trip"] = { parent: "Round" };

export function getPreset(id) {
  return presets[id];
}
