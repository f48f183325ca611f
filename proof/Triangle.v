(* SPDX-License-Identifier: MIT *)
(* The bent elbow, in its plane. The arm's two angles, flexion theta and lift beta, are handled by the logarithms of
   their half tangents. Roundings of products are factors exp tau and exp mu of half tangents, so they add up there. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
Open Scope R_scope.

Definition ang x := 2 * atan (exp x).  (* the angle whose half tangent is exp x *)

(* along the straight path of logarithms, the derivative of the angle is its sine, in [0, 1] *)
Definition sech x := 2 * exp x / (1 + exp x * exp x).
Lemma sech_01 x : 0 <= sech x <= 1.
Proof. unfold sech. pose proof (exp_pos x). split.
  - apply Rmult_le_pos. lra. left. apply Rinv_0_lt_compat. nra.
  - apply Rmult_le_reg_r with (1 + exp x * exp x). nra. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by nra.
    pose proof (Rle_0_sqr (exp x - 1)). unfold Rsqr in *. nra. Qed.
Lemma ang_path x d t : is_derive (fun t => ang (x + t * d)) t (d * sech (x + t * d)).
Proof. unfold ang, sech. auto_derive. { exact I. } simpl. pose proof (exp_pos (x + t*d)). field. nra. Qed.

Lemma mvt01 f f' K : (forall t, is_derive f t (f' t)) -> (forall t, Rabs (f' t) <= K) -> Rabs (f 1 - f 0) <= K.
Proof.
  intros D B. destruct (MVT_gen f 0 1 f') as [c [_ E]].
  - intros; apply D.
  - intros x _. apply continuity_pt_filterlim, (ex_derive_continuous f). exists (f' x). apply D.
  - rewrite E. replace (1 - 0) with 1 by ring. rewrite Rmult_1_r. apply B.
Qed.
Lemma ang_near x d K : Rabs d <= K -> Rabs (ang (x + d) - ang x) <= K.
Proof.
  intro H. replace (ang (x + d)) with (ang (x + 1*d)) by (f_equal; ring).
    replace (ang x) with (ang (x + 0*d)) by (f_equal; ring).
  apply (mvt01 (fun t => ang (x + t*d)) (fun t => d * sech (x + t*d))). apply ang_path.
  intro t. rewrite Rabs_mult. pose proof (sech_01 (x + t*d)). rewrite (Rabs_right (sech _)) by lra.
    pose proof (Rabs_pos d). nra.
Qed.
(* the wrist's angle gamma = theta - beta moves by no more than the largest of |tau|, |mu|, |tau - mu| *)
Lemma corner tau mu s1 s2 K : Rabs tau <= K -> Rabs mu <= K -> Rabs (tau - mu) <= K -> 0 <= s1 <= 1 -> 0 <= s2 <= 1 ->
  Rabs (tau * s1 - mu * s2) <= K.
Proof.
  intros H1 H2 H3 [A1 B1] [A2 B2]. assert (0 <= K) by (pose proof (Rabs_pos tau); lra).
  apply Rabs_le. apply Rabs_le_between in H1. apply Rabs_le_between in H2. apply Rabs_le_between in H3.
  destruct (Rle_dec s2 s1).
  - replace (tau*s1 - mu*s2) with (tau*(s1-s2) + (tau-mu)*s2) by ring. split; nra.
  - replace (tau*s1 - mu*s2) with ((tau-mu)*s1 - mu*(s2-s1)) by ring. split; nra.
Qed.
Lemma gamma_near x y tau mu K : Rabs tau <= K -> Rabs mu <= K -> Rabs (tau - mu) <= K ->
  Rabs ((ang (x + tau) - ang (y + mu)) - (ang x - ang y)) <= K.
Proof.
  intros.
  replace (ang (x+tau) - ang (y+mu)) with (ang (x+1*tau) - ang (y+1*mu)) by (f_equal; [|f_equal]; f_equal; ring).
  replace (ang x - ang y) with (ang (x+0*tau) - ang (y+0*mu)) by (f_equal; [|f_equal]; f_equal; ring).
  apply (mvt01 (fun t => ang (x + t*tau) - ang (y + t*mu)) (fun t => tau * sech (x + t*tau) - mu * sech (y+t*mu))).
  - intro t. apply (is_derive_minus (fun t => ang (x + t*tau)) (fun t => ang (y + t*mu))); apply ang_path.
  - intro t. apply corner; try assumption; apply sech_01.
Qed.

(* chord <= arc *)
Lemma sin_abs x : Rabs (sin x) <= Rabs x.
Proof.
  assert (P : forall y, 0 <= y -> Rabs (sin y) <= y).
  { intros y Hy. destruct (Rle_lt_dec y 1) as [L|L].
    - destruct (Req_dec y 0) as [->|N]. rewrite sin_0, Rabs_R0; lra.
      rewrite Rabs_right. left. apply sin_lt_x. lra. apply Rle_ge, sin_ge_0; [lra|]. pose proof PI2_1. lra.
    - pose proof (SIN_bound y). apply Rabs_le. lra. }
  destruct (Rle_lt_dec 0 x). rewrite (Rabs_right x) by lra. auto.
  rewrite <- (Rabs_Ropp (sin x)), <- sin_neg, (Rabs_left x) by assumption. apply P. lra.
Qed.
Lemma chord2 a b : (cos a - cos b)*(cos a - cos b) + (sin a - sin b)*(sin a - sin b) <= (a - b)*(a - b).
Proof.
  assert (E : (cos a - cos b)*(cos a - cos b) + (sin a - sin b)*(sin a - sin b) = 2 - 2 * cos (a - b)).
  { rewrite cos_minus. pose proof (sin2_cos2 a). pose proof (sin2_cos2 b). unfold Rsqr in *. nra. }
  rewrite E. replace (a - b) with (2 * ((a-b)/2)) at 1 by field. rewrite cos_2a_sin.
  set (y := (a-b)/2). pose proof (sin_abs y) as S.
  assert (sin y * sin y <= y * y).
  { pose proof (Rabs_pos (sin y)). replace (sin y * sin y) with (Rabs (sin y) * Rabs (sin y)) by (unfold Rabs;
    destruct (Rcase_abs (sin y)); ring).
    replace (y*y) with (Rabs y * Rabs y) by (unfold Rabs; destruct (Rcase_abs y); ring). nra. }
  replace ((a-b)*(a-b)) with (4*(y*y)) by (unfold y; field). lra.
Qed.
Lemma weighted L1 L2 p q r s K : 0 <= L1 -> 0 <= L2 -> 0 <= K -> p*p + q*q <= K*K -> r*r + s*s <= K*K ->
  (L1*p + L2*r)*(L1*p + L2*r) + (L1*q + L2*s)*(L1*q + L2*s) <= ((L1+L2)*K)*((L1+L2)*K).
Proof.
  intros. assert (2*(p*r + q*s) <= (p*p+q*q) + (r*r+s*s)). { pose proof (Rle_0_sqr (p-r)).
    pose proof (Rle_0_sqr (q-s)). unfold Rsqr in *. nra. }
  assert (0 <= L1*L2) by nra. assert (0 <= L1*L1) by nra. assert (0 <= L2*L2) by nra.
  assert (L1*L2*(2*(p*r+q*s)) <= L1*L2*(2*(K*K))). { apply Rmult_le_compat_l; lra. }
  assert (L1*L1*(p*p+q*q) <= L1*L1*(K*K)) by (apply Rmult_le_compat_l; lra).
  assert (L2*L2*(r*r+s*s) <= L2*L2*(K*K)) by (apply Rmult_le_compat_l; lra). nra.
Qed.

(* The bent elbow of an exact triangle (d; L1, L2) closes at distance d straight along the line. With half tangents off
   by exp tau and exp mu, its wrist is off by (L1 + L2) K at most. Wrist: (L2 sin g - L1 sin b, L1 cos b + L2 cos g). *)
Theorem planar L1 L2 d x y tau mu K :
  0 <= L1 -> 0 <= L2 -> 0 <= K ->
  L2 * sin (ang x - ang y) - L1 * sin (ang y) = 0 -> L1 * cos (ang y) + L2 * cos (ang x - ang y) = d ->
  Rabs tau <= K -> Rabs mu <= K -> Rabs (tau - mu) <= K ->
  let b := ang (y + mu) in let g := ang (x + tau) - ang (y + mu) in
  (L2 * sin g - L1 * sin b)*(L2 * sin g - L1 * sin b) + (L1 * cos b + L2 * cos g - d)*(L1 * cos b + L2 * cos g - d)
    <= ((L1+L2)*K)*((L1+L2)*K).
Proof.
  intros H1 H2 HK E0 Ed Ht Hm Htm b g.
  pose proof (ang_near y mu K Hm) as Nb. pose proof (gamma_near x y tau mu K Ht Hm Htm) as Ng.
  fold b in Nb. fold g in Ng. set (b0 := ang y) in *. set (g0 := ang x - b0) in *.
  assert (SQ : forall z, Rabs z <= K -> z*z <= K*K).
  { intros z Hz. pose proof (Rabs_pos z). replace (z*z) with (Rabs z * Rabs z) by (unfold Rabs; destruct (Rcase_abs z);
    ring). nra. }
  pose proof (chord2 b b0) as Cb. pose proof (chord2 g g0) as Cg. apply SQ in Nb. apply SQ in Ng.
  replace (L2 * sin g - L1 * sin b) with (L1 * (-(sin b - sin b0)) + L2 * (sin g - sin g0)) by lra.
  replace (L1 * cos b + L2 * cos g - d) with (L1 * (cos b - cos b0) + L2 * (cos g - cos g0)) by lra.
  apply weighted; lra.
Qed.

(* The exact triangle: its half tangents are sqrt (B/A) and sqrt (M/P), and it closes. F = L1+L2, D = L1-L2. *)
Lemma exp_half_ln t : 0 < t -> exp (ln t / 2) = sqrt t.
Proof. intro H. rewrite <- (sqrt_square (exp (ln t / 2))) by (left; apply exp_pos). f_equal. rewrite <- exp_plus.
  replace (ln t / 2 + ln t / 2) with (ln t) by field. now apply exp_ln. Qed.
Lemma cos_ang t : 0 < t -> cos (ang (ln t / 2)) = (1 - t)/(1 + t) /\ sin (ang (ln t / 2)) = 2 * sqrt t / (1 + t).
Proof.
  intro H. unfold ang. rewrite exp_half_ln by assumption. set (r := sqrt t).
    assert (Hr : r*r = t) by (apply sqrt_sqrt; lra).
  assert (0 < r) by now apply sqrt_lt_R0.
  assert (S : sqrt (1 + r²) * sqrt (1 + r²) = 1 + r²) by (apply sqrt_sqrt; unfold Rsqr; nra).
  assert (0 < sqrt (1 + r²)) by (apply sqrt_lt_R0; unfold Rsqr; nra).
  rewrite cos_2a, sin_2a, cos_atan, sin_atan. split.
  - replace (1 / sqrt (1 + r²) * (1 / sqrt (1 + r²)) - r / sqrt (1 + r²) * (r / sqrt (1 + r²))) with ((1 - r*r) / (sqrt
    (1 + r²) * sqrt (1 + r²))) by (field; lra).
    rewrite S. unfold Rsqr. rewrite Hr. reflexivity.
  - replace (2 * (r / sqrt (1 + r²)) * (1 / sqrt (1 + r²))) with (2*r/(sqrt (1 + r²) * sqrt (1 + r²))) by (field; lra).
    rewrite S. unfold Rsqr. rewrite Hr. reflexivity.
Qed.
Lemma triangle_closes F D d : 0 < d -> Rabs D < d -> d < F ->
  let A := (d - D)*(d + D) in let B := (F - d)*(F + d) in let P := (d + D)*(F + d) in let M := (d - D)*(F - d) in
  let L1 := (F + D)/2 in let L2 := (F - D)/2 in
  let th := ang (ln (B/A) / 2) in let be := ang (ln (M/P) / 2) in
  L2 * sin (th - be) - L1 * sin be = 0 /\ L1 * cos be + L2 * cos (th - be) = d.
Proof.
  intros Hd HD HF A B P M L1 L2 th be. apply Rabs_def2 in HD.
  assert (0 < A) by (unfold A; apply Rmult_lt_0_compat; lra).
    assert (0 < B) by (unfold B; apply Rmult_lt_0_compat; lra).
  assert (0 < P) by (unfold P; apply Rmult_lt_0_compat; lra).
    assert (0 < M) by (unfold M; apply Rmult_lt_0_compat; lra).
  destruct (cos_ang (B/A)) as [Ct St]. { now apply Rdiv_lt_0_compat. }
  destruct (cos_ang (M/P)) as [Cb Sb]. { now apply Rdiv_lt_0_compat. }
  fold th in Ct, St. fold be in Cb, Sb.
  (* one root for both: R = sqrt (A B) = sqrt (P M) *)
  set (R := sqrt (A*B)). assert (HR : R*R = A*B) by (apply sqrt_sqrt; nra).
  assert (HPM : P*M = A*B) by (unfold P, M, A, B; ring).
  assert (Q1 : sqrt (B/A) = R/A). { replace (B/A) with (A*B/(A*A)) by (field; lra). rewrite sqrt_div_alt by nra.
    rewrite sqrt_square by lra. reflexivity. }
  assert (Q2 : sqrt (M/P) = R/P). { replace (M/P) with (A*B/(P*P)) by (rewrite <- HPM; field; lra).
    rewrite sqrt_div_alt by nra. rewrite sqrt_square by lra. reflexivity. }
  rewrite Q1 in St. rewrite Q2 in Sb.
  assert (EF : F + D <> 0) by lra. assert (EG : F - D <> 0) by lra.
  assert (ES : A + B = (F+D)*(F-D)) by (unfold A, B; ring). assert (ET : P + M = 2*d*(F+D)) by (unfold P, M; ring).
  assert (Ct' : cos th = (A - B)/((F+D)*(F-D))). { rewrite Ct, <- ES. field. lra. }
  assert (St' : sin th = 2*R/((F+D)*(F-D))). { rewrite St, <- ES. field. lra. }
  assert (Cb' : cos be = (P - M)/(2*d*(F+D))). { rewrite Cb, <- ET. field. lra. }
  assert (Sb' : sin be = 2*R/(2*d*(F+D))). { rewrite Sb, <- ET. field. lra. }
  rewrite cos_minus, sin_minus, Ct', St', Cb', Sb'. unfold L1, L2. split.
  - replace ((F - D)/2 * (2*R/((F+D)*(F-D)) * ((P-M)/(2*d*(F+D))) - (A-B)/((F+D)*(F-D)) * (2*R/(2*d*(F+D)))) -
    (F+D)/2*(2*R/(2*d*(F+D))))
      with (R * ((P - M) - (A - B) - (F+D)*(F+D)) / (2*d*(F+D)*(F+D))) by (field; lra).
    replace ((P-M) - (A-B) - (F+D)*(F+D)) with 0 by (unfold P, M, A, B; ring). field; lra.
  - replace ((F+D)/2*((P-M)/(2*d*(F+D))) + (F-D)/2*((A-B)/((F+D)*(F-D)) * ((P-M)/(2*d*(F+D))) +
    2*R/((F+D)*(F-D))*(2*R/(2*d*(F+D)))))
      with ((P-M)/(4*d) + ((A-B)*(P-M) + 4*(R*R)) / (4*d*(F+D)*(F+D))) by (field; lra).
    rewrite HR. unfold P, M, A, B. field. lra.
Qed.
