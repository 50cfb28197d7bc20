// Area function of the vowel /i/ [m^2], glottis to lips, 42 sections of equal length. Included by the geometries of this
// folder; another vowel is another table.
// Source: Story, Titze and Hoffman 1996, J. Acoust. Soc. Am. 100, 537, male subject.
section_length = 0.00396825;  // [m] = 350 / (2 * 44100)
areas() = {
  0.33, 0.30, 0.36, 0.34, 0.68, 0.50, 2.43, 3.15, 2.66, 2.49, 3.39, 3.80, 3.78, 4.35,
  4.50, 4.43, 4.68, 4.52, 4.15, 4.09, 3.51, 2.95, 2.03, 1.66, 1.38, 1.05, 0.60, 0.35,
  0.32, 0.12, 0.10, 0.16, 0.25, 0.24, 0.38, 0.28, 0.36, 0.65, 1.58, 2.05, 2.01, 1.58 };
sections = #areas();
For i In {0 : sections - 1}
  areas(i) *= 1e-4;
EndFor
