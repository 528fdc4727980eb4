!> Wrong use of the module gives stat and a message, and changes nothing.
program misuse
  use, intrinsic :: iso_c_binding
  use splashdown
  use legacy_names
  implicit none
  character(len=23), parameter :: settings(2) = [character(len=23) :: "resolution.spacing=0.02", "time.end=0.02"]
  type(splashdown_scene) :: scene, none
  type(splashdown_element) :: water
  type(splashdown_host_nodes) :: nodes, wrong
  type(splashdown_contribution) :: given
  type(splashdown_scene_sizes) :: sizes
  type(sph_element) :: e
  integer(c_int8_t), allocatable :: bytes(:)
  real(c_double), allocatable :: a(:, :), p(:)
  real(c_double) :: force(3, 1), twice(3, 1), time, start, dt
  integer(c_size_t) :: count
  integer :: stat, asked
  character(len=1000) :: text
  character(len=5) :: short
  asked = 0

  call splashdown_open("no_such_scene", settings, SPLASHDOWN_BODY, scene, stat, text)
  call expect(SPLASHDOWN_INPUT, "no_such_scene")
  call splashdown_open("no_such_scene", settings, SPLASHDOWN_BODY, scene, stat, short)
  if (short == "" .or. index(text, short) /= 1) error stop "a short text is the beginning of the whole"
  call splashdown_open("wedge", [character(len=9) :: "no.key=1"], SPLASHDOWN_BODY, scene, stat, text)
  call expect(SPLASHDOWN_INPUT, "no")
  call splashdown_open("wedge", settings, 7, scene, stat, text)
  call expect(SPLASHDOWN_INPUT, "interface")
  call splashdown_sizes(none, sizes, stat, text)
  call expect(SPLASHDOWN_NULL, "scene")
  call gest(e, nodes, stat, text)
  call expect(SPLASHDOWN_NULL, "scene")

  call splashdown_open("wedge", settings, SPLASHDOWN_BODY, scene, stat, text)
  call expect(SPLASHDOWN_OK, "")
  call splashdown_sizes(scene, sizes, stat, text)
  call expect(SPLASHDOWN_OK, "")
  start = sizes%start_time
  call splashdown_scene_nodes(scene, nodes, stat, text)
  call expect(SPLASHDOWN_OK, "")
  call splashdown_build(scene, wrong, water, stat, text)
  call expect(SPLASHDOWN_LENGTH, "position(2, n)")
  wrong = nodes
  deallocate (wrong%rotation)
  call splashdown_build(scene, wrong, water, stat, text)
  call expect(SPLASHDOWN_NULL, "rotations")
  call splashdown_build(scene, nodes, water, stat, text)
  call expect(SPLASHDOWN_OK, "")
  call splashdown_sizes(scene, sizes, stat, text)
  call expect(SPLASHDOWN_NO_HANDLE, "consumed")

  call splashdown_restore(water, stat, text)
  call expect(SPLASHDOWN_NOTHING_SAVED, "")
  nodes%position(2, 1) = nodes%position(2, 1) + 1e-4_c_double*nodes%velocity(2, 1)
  wrong = nodes
  wrong%velocity = reshape([1.0_c_double, 2.0_c_double, 3.0_c_double, 4.0_c_double], [2, 2])
  call splashdown_contribute(water, 1e-4_c_double, wrong, force, given, stat, text)
  call expect(SPLASHDOWN_LENGTH, "velocity(2, n)")
  call splashdown_contribute(water, -1.0_c_double, nodes, force, given, stat, text)
  call expect(SPLASHDOWN_INPUT, "")
  call splashdown_state(water, bytes, stat, text)
  call expect(SPLASHDOWN_OK, "")
  call splashdown_contribute(water, 1e-4_c_double, nodes, force, given, stat, text)
  call expect(SPLASHDOWN_OK, "")
  call splashdown_state_read(water, bytes(1:9), stat, text)
  call expect(SPLASHDOWN_NO_STATE, "")
  call splashdown_save(water, stat, text)
  call expect(SPLASHDOWN_FAILED, "")
  call splashdown_state_read(water, bytes, stat, text)
  call expect(SPLASHDOWN_OK, "")
  call splashdown_contribute(water, 1e-4_c_double, nodes, twice, stat=stat, message=text)
  call expect(SPLASHDOWN_OK, "")
  if (any(abs(twice - force) > 0.0_c_double) .or. given%fluid_steps < 1) error stop "a state read back gives other forces"
  call splashdown_forces_now(water, twice, stat, text)
  call expect(SPLASHDOWN_OK, "")
  call splashdown_nodes_now(water, wrong, stat, text)
  call expect(SPLASHDOWN_LENGTH, "")
  wrong = nodes
  call splashdown_nodes_now(water, wrong, stat, text)
  call expect(SPLASHDOWN_OK, "")
  if (any(abs(wrong%position - nodes%position) > 0.0_c_double)) error stop "the nodes are elsewhere"
  call splashdown_time(water, time)
  call splashdown_fluid_dt(water, dt)
  if (time <= start .or. dt <= 0.0_c_double) error stop "time goes on by positive steps"
  call splashdown_particle_count(water, count)
  allocate (a(count, 6), p(count - 1))
  call splashdown_particles(water, a(:, 1), a(:, 2), a(:, 3), a(:, 4), p, a(:, 6), stat, text)
  call expect(SPLASHDOWN_LENGTH, "particles")
  call splashdown_particles(water, a(:, 1), a(:, 2), a(:, 3), a(:, 4), a(:, 5), a(:, 6), stat, text)
  call expect(SPLASHDOWN_OK, "")
  if (any(abs(a(:, 6)) <= 0.0_c_double)) error stop "particles have spacings"
  call splashdown_free_element(water, stat, text)
  call expect(SPLASHDOWN_OK, "")
  call splashdown_free_element(water, stat, text)
  call expect(SPLASHDOWN_NO_HANDLE, "freed")
  deallocate (bytes, a, p)
  print "(a, i0, a)", "misuse in Fortran: ", asked, " answers as expected"

contains

  !> stat is `status`, and text has `part` in it.
  subroutine expect(status, part)
    integer(c_int), intent(in) :: status
    character(len=*), intent(in) :: part
    asked = asked + 1
    if (stat == status .and. (status == 0 .or. index(text, part) > 0)) return
    print *, asked, stat, status, part, " ", trim(text)
    error stop "not the expected answer"
  end subroutine
end program
