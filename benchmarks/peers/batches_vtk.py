"""Cubemaps of a field in VTK: an actor for each object, and a picture for each face; VTK culls by itself."""

from __future__ import annotations

from typing import Any

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy

from .. import field, scene


class Actors:
    """The field in one window off the screen; it has colours alone."""

    def __init__(self, **options: Any) -> None:
        self.plan = plan = field.Field.of(options)
        if plan.outputs or plan.format != "rgba8":
            raise ValueError(f"VTK reads rgba8 colours alone, got {plan.format}, {plan.outputs}")
        field.keep_freed_memory()
        self.renderer = vtk.vtkRenderer()
        self.renderer.SetBackground(*field.CLEAR[:3])
        self.renderer.SetAutomaticLightCreation(False)
        self.renderer.TwoSidedLightingOff()
        for x, y, z, is_place in plan.light_places.tolist():
            light = vtk.vtkLight()
            light.SetLightTypeToSceneLight()
            light.SetPositional(bool(is_place))
            light.SetConeAngle(180)  # not a spot light
            light.SetPosition(x, y, z)
            light.SetFocalPoint(0, 0, 0)
            light.SetIntensity(1 / plan.lights)
            self.renderer.AddLight(light)
        mesh, ground = self._mapper(plan.mesh), self._mapper(plan.ground)
        for number, (place, turn) in enumerate(zip(plan.places, plan.turns, strict=True)):
            actor = self._actor(mesh, plan.palette[number % plan.colors])
            actor.SetPosition(*place)
            actor.RotateY(float(np.degrees(turn)))
        if plan.nodes:
            self._actor(ground, field.GROUND_COLOR)
        self.window = vtk.vtkRenderWindow()
        self.window.SetOffScreenRendering(True)
        self.window.SetMultiSamples(plan.samples if plan.samples > 1 else 0)
        self.window.SetSize(plan.size, plan.size)
        self.window.AddRenderer(self.renderer)
        self.camera = self.renderer.GetActiveCamera()
        self.camera.SetViewAngle(90)
        self.camera.SetClippingRange(field.NEAR, field.FAR)
        self.pixels = vtk.vtkUnsignedCharArray()

    def _mapper(self, mesh: scene.MeshArrays) -> vtk.vtkPolyDataMapper:
        points, cells, data = vtk.vtkPoints(), vtk.vtkCellArray(), vtk.vtkPolyData()
        points.SetData(numpy_to_vtk(mesh.positions, deep=True))
        count = len(mesh.indices)
        threes = np.hstack([np.full((count, 1), 3), mesh.indices]).astype(np.int64)
        cells.SetCells(count, numpy_to_vtkIdTypeArray(threes.ravel(), deep=True))
        data.SetPoints(points)
        data.SetPolys(cells)
        data.GetPointData().SetNormals(numpy_to_vtk(mesh.normals, deep=True))
        mapper = vtk.vtkPolyDataMapper()
        mapper.SetInputData(data)
        mapper.SetStatic(True)
        return mapper

    def _actor(self, mapper: vtk.vtkPolyDataMapper, color: Any) -> vtk.vtkActor:
        actor = vtk.vtkActor()
        actor.SetMapper(mapper)
        look = actor.GetProperty()
        look.SetColor(*color)
        look.SetInterpolationToPhong()
        look.SetAmbient(field.KA)
        look.SetDiffuse(field.KD)
        look.SetSpecular(field.KS)
        look.SetSpecularColor(1, 1, 1)
        look.SetSpecularPower(field.SHININESS)
        look.BackfaceCullingOn()
        self.renderer.AddActor(actor)
        return actor

    def prepare(self, index: int) -> None:
        self.positions = self.plan.positions(index)

    def draw(self, index: int) -> dict[str, np.ndarray]:
        """(probes, 6, N, N, 4) uint8: "faces"."""
        n = self.plan.size
        found = self.plan.results(len(self.positions))
        for number, place in enumerate(self.positions):
            self.camera.SetPosition(*place)
            for face, (forward, up) in enumerate(
                zip(scene.FACE_FORWARD, scene.FACE_UP, strict=True)
            ):
                self.camera.SetFocalPoint(*(place + forward))
                self.camera.SetViewUp(*up)
                self.window.Render()
                self.window.GetRGBACharPixelData(0, 0, n - 1, n - 1, 0, self.pixels)
                found["faces"][number, face] = vtk_to_numpy(self.pixels).reshape(n, n, 4)
        found["faces"][..., 3] = 255  # of VTK's background it is 0
        return found

    def arrays(self, index: int) -> dict[str, np.ndarray]:
        """As `draw`."""
        self.prepare(index)
        return self.draw(index)
