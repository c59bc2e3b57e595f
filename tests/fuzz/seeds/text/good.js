// a
export const a = [ 1, - 2e-05, .5, 1., ], b = new C('=[1');
c = [d, 1];