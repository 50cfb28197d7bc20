#!/usr/bin/python3
"""Spectra, resampling and harmonics against those of scipy.  Usage: against_scipy.py SIGNAL_PROBE"""

import pathlib
import sys
import tempfile
import unittest

import numpy

import probe

try:
    import scipy.io.wavfile
    import scipy.signal
except ImportError:
    probe.skip("the Debian package python3-scipy is not installed")

RATE = 44100  # [Hz]


class AgainstScipy(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        chance = numpy.random.default_rng(4)
        noise = chance.standard_normal(RATE // 2)
        low = scipy.signal.cheby2(12, 100, 8000, fs=RATE, output="sos")
        cls.noise = cls.write("noise.wav", noise)
        cls.band = cls.write("band.wav", scipy.signal.sosfilt(low, noise) * scipy.signal.windows.tukey(noise.size, 0.2))

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    @classmethod
    def write(cls, name, values):
        """The file, and its samples as all read them."""
        path = cls.folder / name
        scipy.io.wavfile.write(path, RATE, values.astype(numpy.float32))
        return path, values.astype(numpy.float32).astype(float)

    def assert_close(self, ours, theirs, tolerance):
        self.assertEqual(ours.shape, theirs.shape)
        difference = numpy.abs(ours - theirs).max() / numpy.abs(theirs).max()
        self.assertLess(difference, tolerance)

    def test_power_spectral_density(self):
        path, values = self.noise
        for segment in (256, 1001, 4096):
            frequency, density = scipy.signal.welch(values, RATE, window="hann", nperseg=segment)
            ours = probe.call("welch", path, segment)
            self.assert_close(ours[:, 0], frequency, 1e-12)
            numpy.testing.assert_allclose(ours[:, 1], density, rtol=1e-9)

    def test_resampling(self):
        # By Fourier series, which is exact for a signal that begins and ends at zero and has nothing above 8 kHz, well
        # below half of the lowest rate.
        path, values = self.band
        for rate in (88200, 48000, 22050):
            count = values.size * rate // RATE
            theirs = scipy.signal.resample(values, count)
            ours = probe.call("resample", path, rate)[:, 0][:count]
            self.assert_close(ours, theirs[:ours.size], 3e-4)

    def test_levels_and_harmonics(self):
        path, values = self.band
        level = 20 * numpy.log10(values.std() / 20e-6)
        self.assertAlmostEqual(probe.call("level", path)[0, 0], level, places=9)
        time = numpy.arange(RATE // 2) / RATE
        amplitudes = 1 / numpy.arange(1, 21) ** 1.5
        tone = sum(a * numpy.cos(2 * numpy.pi * 220.5 * k * time + k) for k, a in enumerate(amplitudes, 1))
        path, tone = self.write("tone.wav", tone)
        line = numpy.abs(numpy.fft.rfft(tone[-100 * 200:])) / (50 * 200)  # 100 periods of 200 samples
        ours = probe.call("harmonics", path, 220.5)
        self.assert_close(ours[:20, 1], line[100:2001:100], 1e-6)
        self.assert_close(ours[:20, 2], 20 * numpy.log10(amplitudes / numpy.sqrt(2) / 20e-6), 1e-5)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
