// Area function of a vocal tract, glottis to lips. Included by the geometries of this folder; another vowel is another
// table in the [mesh.parameters] of a case. These are of /i/: Story, Titze and Hoffman 1996, J. Acoust. Soc. Am. 100, 537,
// male subject, 42 sections.
DefineConstant[
  areas() = {{
    0.33e-4, 0.30e-4, 0.36e-4, 0.34e-4, 0.68e-4, 0.50e-4, 2.43e-4, 3.15e-4, 2.66e-4, 2.49e-4, 3.39e-4, 3.80e-4,
    3.78e-4, 4.35e-4, 4.50e-4, 4.43e-4, 4.68e-4, 4.52e-4, 4.15e-4, 4.09e-4, 3.51e-4, 2.95e-4, 2.03e-4, 1.66e-4,
    1.38e-4, 1.05e-4, 0.60e-4, 0.35e-4, 0.32e-4, 0.12e-4, 0.10e-4, 0.16e-4, 0.25e-4, 0.24e-4, 0.38e-4, 0.28e-4,
    0.36e-4, 0.65e-4, 1.58e-4, 2.05e-4, 2.01e-4, 1.58e-4}},
  area_unit = 1,               // [m^2] of the areas: 1e-4 if they are in cm^2
  section_length = 0.00396825  // [m] of each section: 350 / (2 * 44100)
];
sections = #areas();
For i In {0 : sections - 1}
  area(i) = areas(i) * area_unit;  // [m^2]
EndFor
