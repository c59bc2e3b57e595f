static ushort[] a = new ushort[1 * 1 * 4]
{ 15360, 0, 48128, 31743, };