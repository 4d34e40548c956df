"""Draws surfaces by VTK without a screen: by EGL, which uses Mesa in memory if there is no graphics card."""
import ctypes

import numpy as np
from scipy.ndimage import uniform_filter
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkObject
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals
from vtkmodules.vtkRenderingCore import vtkActor, vtkLight, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter
from vtkmodules.vtkRenderingOpenGL2 import vtkGenericOpenGLRenderWindow

FINER = 2  # drawn pixels per pixel of the picture, along each side
TO_LIGHT = (-0.42, 0.55, 0.72)  # right, up, towards the eye: light from the upper left, behind the viewer
MOST_POINTS = 2**24 - 1  # that colors can tell apart


class Camera:
    """Parallel projection. `towards` points from the body to the eye; z is up, unless one looks along it."""

    def __init__(self, towards):
        d = np.array(towards, float) / np.linalg.norm(towards)
        up = np.array([0, 0, 1.0]) if abs(d[2]) < 0.999 else np.array([0, 1.0, 0])
        right = np.cross(up, d)
        right /= np.linalg.norm(right)
        self.axes = np.stack([right, np.cross(d, right), d])

    def seen(self, places):
        """Coordinates to the right, up, and towards the eye."""
        return places @ self.axes.T

    def frame(self, low, high, width, height, zoom=1):
        """Fits the box from low to high (as seen) into width x height pixels, then nears by the zoom."""
        self.middle, self.depth = 0.5 * (low + high), max(high[2] - low[2], 1e-3 * np.max(high - low))
        size = 1.04 * np.maximum(high - low, 1e-9 * np.max(high - low))[:2]
        fit = max(size[0] / width, size[1] / height)
        self.width, self.height = max(16, int(np.ceil(size[0] / fit))), max(16, int(np.ceil(size[1] / fit)))
        self.pixel = fit / zoom

    def aim(self, camera):
        """Sets VTK's camera."""
        focus = self.middle @ self.axes
        camera.ParallelProjectionOn()
        camera.SetFocalPoint(focus)
        camera.SetPosition(focus + 2 * self.depth * self.axes[2])
        camera.SetViewUp(self.axes[1])
        camera.SetParallelScale(0.5 * self.height * self.pixel)
        camera.SetClippingRange(self.depth, 3 * self.depth)


# The window


def make_current():
    """Makes a context of EGL current that needs no display; False if there is none."""
    try:
        egl = ctypes.CDLL("libEGL.so.1")
    except OSError:
        return False
    pointer, found = ctypes.c_void_p, ctypes.c_int()
    egl.eglGetPlatformDisplay.restype = egl.eglCreateContext.restype = pointer

    def words(*numbers):
        return (ctypes.c_int * len(numbers))(*numbers)
    display = pointer(egl.eglGetPlatformDisplay(0x31DD, None, None))  # EGL_PLATFORM_SURFACELESS_MESA
    config = pointer()
    if not egl.eglInitialize(display, None, None) or not egl.eglBindAPI(0x30A2):  # EGL_OPENGL_API
        return False
    # EGL_SURFACE_TYPE: EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE: EGL_OPENGL_BIT; then version 3.2 with the core profile.
    egl.eglChooseConfig(display, words(0x3033, 1, 0x3040, 8, 0x3038), ctypes.byref(config), 1, ctypes.byref(found))
    context = pointer(egl.eglCreateContext(display, config, None, words(0x3098, 3, 0x30FB, 2, 0x30FD, 1, 0x3038)))
    return bool(found.value and egl.eglMakeCurrent(display, None, None, context))


def new_window():
    if not make_current():
        window = vtkRenderWindow()  # of a display
        window.SetOffScreenRendering(True)
        return window
    window = vtkGenericOpenGLRenderWindow()
    for option in ("ReadyForRendering", "SupportsOpenGL", "IsDirect", "IsCurrent", "OffScreenRendering", "UseOffScreenBuffers"):
        getattr(window, "Set" + option)(True)
    window.SetOwnContext(False)
    window.SetShowWindow(False)
    vtkObject.GlobalWarningDisplayOff()  # GLEW in VTK warns that there is no display; it needs none
    window.OpenGLInit()
    return window


class Painter:
    """Draws one surface at a time."""

    def __init__(self):
        self.window, self.renderer, self.light, self.actor = new_window(), vtkRenderer(), vtkLight(), vtkActor()
        self.normals, self.mapper = vtkPolyDataNormals(), vtkPolyDataMapper()
        self.normals.SplittingOff()
        self.normals.ConsistencyOff()
        self.mapper.SetScalarModeToUseCellData()
        self.mapper.SetColorModeToDirectScalars()
        self.actor.SetMapper(self.mapper)
        self.light.SetLightTypeToCameraLight()
        self.light.SetFocalPoint(0, 0, 0)
        self.renderer.AutomaticLightCreationOff()
        self.renderer.AddLight(self.light)
        self.renderer.AddActor(self.actor)
        self.renderer.SetBackground(0, 0, 0)
        self.window.SetMultiSamples(0)
        self.window.AddRenderer(self.renderer)

    def take(self, data, camera):
        """Sets the data and the camera of the next images."""
        self.normals.SetInputData(data)
        self.normals.Update()
        self.mapper.SetInputData(self.normals.GetOutput())
        self.window.SetSize(FINER * camera.width, FINER * camera.height)
        camera.aim(self.renderer.GetActiveCamera())
        self.camera, self.shape = camera, (FINER * camera.height, FINER * camera.width)

    def image(self, numbers=None):
        """Red, green and blue, 0 to 255; numbers: of the faces, drawn as their colors."""
        self.mapper.SetScalarVisibility(numbers is not None)
        self.actor.GetProperty().SetLighting(numbers is None)
        if numbers is not None:
            colors = numbers.astype("<u4").view(np.uint8).reshape(-1, 4)[:, :3]
            self.mapper.GetInput().GetCellData().SetScalars(numpy_to_vtk(np.ascontiguousarray(colors), deep=True))
        self.window.Render()
        return self.grabbed("RGB")

    def grabbed(self, kind):
        grab = vtkWindowToImageFilter()
        grab.SetInput(self.window)
        getattr(grab, f"SetInputBufferTypeTo{kind}")()
        grab.ReadFrontBufferOff()
        grab.ShouldRerenderOff()
        grab.Update()
        found = grab.GetOutput()
        width, height, _ = found.GetDimensions()
        return vtk_to_numpy(found.GetPointData().GetScalars()).reshape(height, width, -1)[::-1]

    def shade(self, light, ambient=0.0, diffuse=1.0):
        """How bright a white surface is, 0 to 1, with light from there; and how near it is to the eye, -inf where there is none."""
        self.light.SetPosition(light)
        self.actor.GetProperty().SetAmbient(ambient)
        self.actor.GetProperty().SetDiffuse(diffuse)
        bright, depth = self.image()[..., 0] / 255, self.grabbed("ZBuffer")[..., 0]
        return bright, np.where(depth < 1, self.camera.depth * (1 - 2 * depth), -np.inf)


# Light


def openness(near, pixel):
    """1 where light comes from all sides, less for a pixel that lies behind its surroundings (Luft, Colditz and Deussen
    2006), at three sizes. At the body's outline, where the surroundings are on one side only, nothing is known."""
    seen = np.isfinite(near)
    near, light = np.where(seen, near, 0), np.ones(near.shape)
    for part, strength in ((120, 0.35), (40, 0.4), (14, 0.35)):
        size = 2 * max(FINER, max(near.shape) // part // 2) + 1
        share, mean = (uniform_filter(uniform_filter(image, size, mode="constant"), size, mode="constant") for image in (1.0 * seen, near))
        behind = mean / np.maximum(share, 1e-9) - near
        light *= 1 - strength * np.clip(behind / (size * pixel / FINER), 0, 1) * np.clip(2 * share - 1, 0, 1)
    return light


def coarser(image):
    """FINER x FINER pixels -> one."""
    height, width = image.shape[0] // FINER, image.shape[1] // FINER
    return image.reshape(height, FINER, width, FINER, -1).mean(axis=(1, 3))


class Solid:
    """The visible side of a surface of points: the point at each fine pixel, its light, and its depth."""

    def __init__(self, painter, data, points, camera):
        painter.take(data, camera)
        self.light, self.near = painter.shade(TO_LIGHT, 0.54, 0.46)
        self.light *= openness(self.near, camera.pixel) * (1 - 0.22 * np.clip(0.5 - self.near / camera.depth, 0, 1))
        self.seen = np.isfinite(self.near)
        numbers = painter.image(points).astype(np.uint32)
        self.point = (numbers[..., 0] + (numbers[..., 1] << 8) + (numbers[..., 2] << 16))[self.seen]

    def image(self, colors):
        """Red, green, blue, alpha of the fine pixels; colors: of all points."""
        image = np.zeros((*self.near.shape, 4))
        image[self.seen, :3] = colors[self.point] * self.light[self.seen, None]
        image[self.seen, 3] = 1
        return image


class Glass:
    """A transparent surface of one color; it is denser where it is seen at a slant."""

    def __init__(self, painter, data, color, camera):
        painter.take(data, camera)
        facing, self.near = painter.shade((0, 0, 1))
        self.share = np.where(np.isfinite(self.near), 0.22 + 0.5 * (1 - facing)**2, 0)[..., None]
        self.color = color * (0.55 + 0.45 * facing[..., None])

    def over(self, image, near):
        """The image with the glass over it where the glass is nearer; colors are premultiplied by alpha."""
        share = np.where(self.near > near, self.share[..., 0], 0)[..., None]
        return np.concatenate([share * self.color, share], axis=2) + (1 - share) * image
